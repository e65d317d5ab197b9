// Writing an Image as an OpenEXR file, a band of rows at a time.
#include "host/error.h"
#include "host/image/exr.h"
#include "host/image/exr_names.h"

#include <ImfChannelList.h>
#include <ImfDoubleAttribute.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfIntAttribute.h>
#include <ImfOutputFile.h>
#include <ImfStandardAttributes.h>
#include <ImfStdIO.h>
#include <ImfStringAttribute.h>
#include <ImfThreading.h>
#include <half.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <fstream>
#include <limits>
#include <new>
#include <stdexcept>

namespace parhelion {

namespace {

std::size_t byte_size(Imf::PixelType type) { return type == Imf::HALF ? 2 : 4; }

void check_image(const Image& image) {
    if (image.width < 1 || image.height < 1 || image.full_width < 1 || image.full_height < 1)
        throw std::invalid_argument("an image needs at least one pixel");
    if (image.channels.empty()) throw std::invalid_argument("an image needs at least one channel");
}

void insert_metadata(Imf::Header& header, const std::string& name, const MetadataValue& value) {
    if (name.empty() || name.size() > 255 || header.find(name) != header.end())
        throw std::invalid_argument("metadata name '" + name + "' is empty, too long or taken");
    if (const auto* text = std::get_if<std::string>(&value)) {
        header.insert(name, Imf::StringAttribute(*text));
    } else if (const auto* number = std::get_if<double>(&value)) {
        header.insert(name, Imf::DoubleAttribute(*number));
    } else {
        const std::int64_t integer = std::get<std::int64_t>(value);
        if (integer == static_cast<int>(integer))
            header.insert(name, Imf::IntAttribute(static_cast<int>(integer)));
        else
            header.insert(name, Imf::StringAttribute(std::to_string(integer)));
    }
}

Imf::Header make_header(const Image& image, const ExrOptions& options) {
    using Imath::Box2i;
    using Imath::V2i;
    const Box2i display(V2i(0, 0), V2i(image.full_width - 1, image.full_height - 1));
    const V2i corner(image.offset_x, image.offset_y);
    const Box2i data(corner, corner + V2i(image.width - 1, image.height - 1));
    Imf::Header header(display, data, 1.0f, Imath::V2f(0, 0), 1.0f, Imf::INCREASING_Y,
                       exr_compression(options.compression));
    // Noise hardly compresses: measured, level 4 makes files 0.3 % smaller in a tenth more time.
    header.zipCompressionLevel() = 2;
    Imf::addChromaticities(header, Imf::Chromaticities()); // the default is Rec. 709 with D65
    for (const Channel& channel : image.channels)
        header.channels().insert(channel.name,
                                 Imf::Channel(exr_component(options.component_of(channel.name))));
    for (const auto& [name, value] : image.metadata)
        insert_metadata(header, name, value);
    return header;
}

/// Stores the value at `out`; false where the type cannot hold it (see write_exr).
bool store(Imf::PixelType type, float value, char* out) {
    if (type == Imf::FLOAT) {
        std::memcpy(out, &value, sizeof value);
        return true;
    }
    if (type == Imf::HALF) {
        const Imath::half rounded(value);
        const auto bits = rounded.bits();
        std::memcpy(out, &bits, sizeof bits);
        return rounded.isFinite() || !std::isfinite(value);
    }
    constexpr double largest = std::numeric_limits<std::uint32_t>::max();
    const double rounded = std::nearbyint(static_cast<double>(value));
    const bool fits = rounded >= 0.0 && rounded <= largest;
    const double stored = std::isnan(rounded) ? 0.0 : std::clamp(rounded, 0.0, largest);
    const auto integer = static_cast<std::uint32_t>(stored);
    std::memcpy(out, &integer, sizeof integer);
    return fits;
}

/// Converts a channel of a band of rows; notes the values that are not finite or that the type
/// cannot hold.
void convert(const Image& band, std::size_t channel, Imf::PixelType type, char* out,
             Misfits& misfits) {
    const std::vector<float>& source = band.channels[channel].values;
    const std::size_t bytes = byte_size(type);
    for (std::size_t i = 0; i < source.size(); ++i) {
        const bool fits = store(type, source[i], out + i * bytes);
        const bool finite = std::isfinite(source[i]);
        if (fits && finite) continue;
        misfits.add(band.offset_x + static_cast<int>(i % band.width),
                    band.offset_y + static_cast<int>(i / band.width), source[i], finite);
    }
}

/// Converts and writes all rows; returns what did not fit, an entry a channel.
std::vector<Misfits> write_rows(Imf::OutputFile& output, const ImageRows& image) {
    const Image& frame = image.frame();
    const int band_rows = image.band_rows();
    std::vector<std::vector<char>> converted;
    std::vector<Misfits> misfits;
    converted.reserve(frame.channels.size()), misfits.reserve(frame.channels.size());
    for (const Channel& channel : frame.channels) {
        const Imf::PixelType type = output.header().channels()[channel.name].type;
        converted.emplace_back(byte_size(type) * frame.width * band_rows);
        misfits.push_back({.channel = channel.name});
    }
    for (int first = 0; first < frame.height; first += band_rows) {
        const int rows = std::min(band_rows, frame.height - first);
        const Image band = image.rows(first, rows);
        Imf::FrameBuffer buffer;
        for (std::size_t c = 0; c < frame.channels.size(); ++c) {
            const std::string& name = frame.channels[c].name;
            const Imf::PixelType type = output.header().channels()[name].type;
            const std::size_t bytes = byte_size(type);
            convert(band, c, type, converted[c].data(), misfits[c]);
            buffer.insert(name, Imf::Slice::Make(type, converted[c].data(),
                                                 Imath::V2i(band.offset_x, band.offset_y),
                                                 band.width, rows, bytes, bytes * band.width));
        }
        output.setFrameBuffer(buffer);
        output.writePixels(rows);
    }
    std::erase_if(misfits, [](const Misfits& channel) { return channel.count() == 0; });
    return misfits;
}

/// `file`: its name in messages.
std::vector<Misfits> write_stream(const std::string& temporary, const std::string& file,
                                  const ImageRows& image, const ExrOptions& options) {
    const Imf::Header header = make_header(image.frame(), options);
    std::ofstream stream(temporary, std::ios::binary | std::ios::trunc);
    if (!stream) throw std::runtime_error(std::strerror(errno));
    std::vector<Misfits> misfits;
    {
        Imf::StdOFStream sink(stream, file.c_str());
        const int threads = static_cast<int>(
            tbb::global_control::active_value(tbb::global_control::max_allowed_parallelism));
        Imf::setGlobalThreadCount(threads);
        Imf::OutputFile output(sink, header, threads);
        misfits = write_rows(output, image);
    } // writes the line offset table and hides any failure to do so, hence the check below
    stream.close();
    if (!stream) throw std::runtime_error(std::strerror(errno));
    return misfits;
}

} // namespace

std::vector<Misfits> write_exr(const std::string& file, const ImageRows& image,
                               const ExrOptions& options) {
    check_image(image.frame());
    PendingFile pending(file, options.existing);
    std::vector<Misfits> misfits;
    try {
        misfits = write_stream(pending.temporary_name(), file, image, options);
    } catch (const std::invalid_argument&) {
        throw; // a mistake of the caller, not of the disk
    } catch (const InputError&) {
        throw; // of what the rows are made of
    } catch (const std::bad_alloc&) {
        throw;
    } catch (const std::exception& error) {
        throw OutputError(file + ": cannot write: " + error.what());
    }
    pending.commit();
    return misfits;
}

} // namespace parhelion
