// Reading OpenEXR files of unknown origin into an Image: everything is checked before it is
// trusted.
#include "host/error.h"
#include "host/image/exr.h"
#include "host/image/exr_source.h"

#include <ImfChannelList.h>
#include <ImfCompression.h>
#include <ImfDoubleAttribute.h>
#include <ImfFloatAttribute.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfInputPart.h>
#include <ImfIntAttribute.h>
#include <ImfMultiPartInputFile.h>
#include <ImfPartType.h>
#include <ImfRgbaFile.h>
#include <ImfStringAttribute.h>
#include <ImfTileDescription.h>

#include <algorithm>
#include <array>
#include <new>
#include <tuple>
#include <utility>

namespace parhelion {

namespace {

constexpr std::int64_t largest_edge = 1 << 20;    ///< pixels
constexpr std::int64_t largest_image = 1 << 30;   ///< values in all channels together: 4 GiB
constexpr std::int64_t largest_tile = 1 << 26;    ///< values in all channels of one tile
constexpr int band_rows = 256;                    ///< the most rows any compression puts in a chunk
constexpr float first_inexact_uint = 16777216.0f; ///< 2^24

std::int64_t channel_count(const Imf::Header& header) {
    std::int64_t count = 0;
    for (auto i = header.channels().begin(); i != header.channels().end(); ++i)
        ++count;
    return count;
}

std::string box_text(const Imath::Box2i& box) {
    return "[" + std::to_string(box.min.x) + "," + std::to_string(box.min.y) + " to " +
           std::to_string(box.max.x) + "," + std::to_string(box.max.y) + "]";
}

std::pair<std::int64_t, std::int64_t> box_size(const Imath::Box2i& box) {
    return {std::int64_t(box.max.x) - box.min.x + 1, std::int64_t(box.max.y) - box.min.y + 1};
}

/// How many times its input a compression may grow at most; 0 where no bound is known.
std::int64_t largest_gain(Imf::Compression compression) {
    switch (compression) {
    case Imf::NO_COMPRESSION:
        return 1;
    case Imf::RLE_COMPRESSION:
        return 64; // 128 bytes from a count and a byte
    case Imf::ZIPS_COMPRESSION:
    case Imf::ZIP_COMPRESSION:
        return 1032; // of deflate: 258 bytes from two bits
    case Imf::PXR24_COMPRESSION:
        return 1376; // the same, from 3 bytes of each 4
    default:
        return 0;
    }
}

/// Refuses a data window larger than the file could hold: the library would leave the pixels a
/// compressed block is too short for as they are in memory.
void check_plausible(const ExrSource& source, const Imf::Header& header) {
    const std::int64_t gain = largest_gain(header.compression());
    const auto [width, height] = box_size(header.dataWindow());
    std::int64_t pixel_bytes = 0;
    for (auto i = header.channels().begin(); i != header.channels().end(); ++i)
        if (i.channel().xSampling == 1 && i.channel().ySampling == 1)
            pixel_bytes += i.channel().type == Imf::HALF ? 2 : 4;
    if (gain > 0 && width * height * pixel_bytes > gain * source.bytes)
        source.refuse("data window " + box_text(header.dataWindow()) + " is too large for " +
                      std::to_string(source.bytes) + " bytes of file");
}

/// Refuses windows and tiles that are empty or too large before anything is allocated for them.
void check_size(const ExrSource& source, const Imf::Header& header) {
    const std::int64_t channels = channel_count(header);
    if (channels == 0) source.refuse("has no channels");
    for (const Imath::Box2i& box : {header.dataWindow(), header.displayWindow()}) {
        const auto [width, height] = box_size(box);
        if (width < 1 || height < 1 || width > largest_edge || height > largest_edge)
            source.refuse("window " + box_text(box) + " is empty or has an edge above " +
                          std::to_string(largest_edge) + " pixels");
    }
    const auto [width, height] = box_size(header.dataWindow());
    if (width * height > largest_image / channels)
        source.refuse("data window " + box_text(header.dataWindow()) + " with " +
                      std::to_string(channels) + " channels is above " +
                      std::to_string(largest_image) + " values");
    if (header.hasTileDescription()) {
        const Imf::TileDescription& tile = header.tileDescription();
        if (tile.xSize == 0 || tile.ySize == 0 || tile.xSize > largest_edge ||
            tile.ySize > largest_edge ||
            std::int64_t(tile.xSize) * tile.ySize > largest_tile / channels)
            source.refuse("tiles of " + std::to_string(tile.xSize) + "x" +
                          std::to_string(tile.ySize) + " pixels are empty or too large");
    }
}

bool is_luminance_chroma(const Imf::Header& header) {
    const Imf::ChannelList& channels = header.channels();
    return channels.findChannel("Y") && channels.findChannel("RY") && channels.findChannel("BY");
}

void check_part(const ExrSource& source, const Imf::MultiPartInputFile& input, int part) {
    const Imf::Header& header = input.header(part);
    const std::string where = input.parts() > 1 ? "part " + std::to_string(part) + ": " : "";
    if (header.hasType() && Imf::isDeepData(header.type()))
        source.refuse(where + "deep data is not supported");
    check_size(source, header);
    check_plausible(source, header);
    if (header.dataWindow() != input.header(0).dataWindow() ||
        header.displayWindow() != input.header(0).displayWindow())
        source.refuse(where + "windows that differ from those of part 0 are not supported");
    if (!input.partComplete(part)) source.refuse(where + "incomplete: pixels are missing");
    if (input.parts() == 1 && is_luminance_chroma(header)) return;
    for (auto i = header.channels().begin(); i != header.channels().end(); ++i)
        if (i.channel().xSampling != 1 || i.channel().ySampling != 1)
            source.refuse(where + "channel " + i.name() +
                          " is subsampled, which is supported for Y RY BY alone");
}

Image make_windows(const Imf::Header& header) {
    const Imath::Box2i &data = header.dataWindow(), &display = header.displayWindow();
    Image image;
    std::tie(image.width, image.height) = box_size(data);
    std::tie(image.full_width, image.full_height) = box_size(display);
    image.offset_x = data.min.x - display.min.x;
    image.offset_y = data.min.y - display.min.y;
    return image;
}

/// Attributes the format itself defines for every file; the rest is metadata.
bool is_structural(const std::string& name) {
    static const std::array<const char*, 8> names{"name",
                                                  "type",
                                                  "version",
                                                  "view",
                                                  "chunkCount",
                                                  "pixelAspectRatio",
                                                  "screenWindowWidth",
                                                  "maxSamplesPerPixel"};
    return std::find(names.begin(), names.end(), name) != names.end();
}

void read_metadata(const Imf::Header& header, Image& image) {
    for (auto i = header.begin(); i != header.end(); ++i) {
        const std::string name = i.name();
        if (is_structural(name)) continue;
        const Imf::Attribute* attribute = &i.attribute();
        if (const auto* text = dynamic_cast<const Imf::StringAttribute*>(attribute))
            image.metadata.emplace_back(name, text->value());
        else if (const auto* integer = dynamic_cast<const Imf::IntAttribute*>(attribute))
            image.metadata.emplace_back(name, std::int64_t(integer->value()));
        else if (const auto* single = dynamic_cast<const Imf::FloatAttribute*>(attribute))
            image.metadata.emplace_back(name, double(single->value()));
        else if (const auto* number = dynamic_cast<const Imf::DoubleAttribute*>(attribute))
            image.metadata.emplace_back(name, number->value());
    }
}

/// Reads one part's channels band by band: memory grows with what the file really holds.
void read_part(const ExrSource& source, Imf::MultiPartInputFile& input, int index,
               const std::string& prefix, Image& image) {
    Imf::InputPart part(input, index);
    const Imf::ChannelList& list = part.header().channels();
    const Imath::V2i corner = part.header().dataWindow().min;
    const std::size_t first_channel = image.channels.size();
    const bool plausible = largest_gain(part.header().compression()) > 0; // see check_plausible
    for (auto i = list.begin(); i != list.end(); ++i) {
        image.channels.push_back({prefix + i.name(), {}});
        if (plausible) image.channels.back().values.reserve(image.pixel_count());
    }
    for (int first = 0; first < image.height; first += band_rows) {
        const int rows = std::min(band_rows, image.height - first);
        const std::size_t begin = static_cast<std::size_t>(first) * image.width;
        const std::size_t end = begin + static_cast<std::size_t>(rows) * image.width;
        Imf::FrameBuffer frame;
        std::size_t c = first_channel;
        for (auto i = list.begin(); i != list.end(); ++i, ++c) {
            image.channels[c].values.resize(end);
            frame.insert(i.name(), Imf::Slice::Make(Imf::FLOAT, &image.channels[c].values[begin],
                                                    Imath::V2i(corner.x, corner.y + first),
                                                    image.width, rows));
        }
        part.setFrameBuffer(frame);
        part.readPixels(corner.y + first, corner.y + first + rows - 1);
    }
    std::size_t c = first_channel;
    for (auto i = list.begin(); i != list.end(); ++i, ++c) {
        const std::vector<float>& values = image.channels[c].values;
        if (i.channel().type == Imf::UINT && std::any_of(values.begin(), values.end(), [](float v) {
                return v >= first_inexact_uint;
            }))
            source.refuse("channel " + image.channels[c].name +
                          " holds unsigned integers of 2^24 and more, which is not supported");
    }
}

/// The library's own conversion from Y RY BY to R G B (A).
void read_luminance_chroma(const ExrSource& source, bool has_alpha, Image& image) {
    source.stream->seekg(0);
    Imf::RgbaInputFile input(*source.stream);
    const Imath::Box2i window = input.dataWindow();
    const std::array<const char*, 4> names{"R", "G", "B", "A"};
    const std::size_t count = has_alpha ? 4 : 3;
    for (std::size_t c = 0; c < count; ++c)
        image.channels.push_back({names[c], {}});
    std::vector<Imf::Rgba> row(image.width);
    for (int y = window.min.y; y <= window.max.y; ++y) {
        // Row stride 0: whichever row is read, it is stored in `row`.
        input.setFrameBuffer(row.data() - window.min.x, 1, 0);
        input.readPixels(y);
        for (const Imf::Rgba& pixel : row) {
            const std::array<float, 4> values{pixel.r, pixel.g, pixel.b, pixel.a};
            for (std::size_t c = 0; c < count; ++c)
                image.channels[c].values.push_back(values[c]);
        }
    }
}

Image read_checked(const ExrSource& source) {
    // A table of chunks that is broken is an error, not something to rebuild by guessing.
    Imf::MultiPartInputFile input(*source.stream, 0, false);
    for (int part = 0; part < input.parts(); ++part)
        check_part(source, input, part);
    const Imf::Header& header = input.header(0);
    Image image = make_windows(header);
    read_metadata(header, image);
    if (input.parts() == 1 && is_luminance_chroma(header)) {
        read_luminance_chroma(source, header.channels().findChannel("A") != nullptr, image);
        return image;
    }
    for (int part = 0; part < input.parts(); ++part)
        read_part(source, input, part,
                  input.parts() > 1 ? input.header(part).name() + "." : std::string(), image);
    return image;
}

Image read_source(const ExrSource& source) {
    try {
        check_header(source);
        return read_checked(source);
    } catch (const InputError&) {
        throw;
    } catch (const std::bad_alloc&) {
        source.refuse("not enough memory to read it");
    } catch (const std::exception& error) {
        std::string reason = error.what();
        const std::string opening =
            "\"" + source.file + "\". "; // the library names the file as well
        if (const std::size_t at = reason.find(opening); at != std::string::npos)
            reason.erase(0, at + opening.size());
        std::replace(reason.begin(), reason.end(), '\n', ' ');
        source.refuse("cannot be read as OpenEXR: " + reason);
    }
}

} // namespace

Image read_exr(const std::string& file) { return read_source(open_exr(file)); }

Image parse_exr(std::string_view bytes, const std::string& name) {
    return read_source(exr_in_memory(bytes, name));
}

} // namespace parhelion
