// Reading OpenEXR files of unknown origin into an Image: everything is checked before it is
// trusted.
#include "host/error.h"
#include "host/image/exr.h"
#include "host/image/exr_checks.h"

#include <ImfChannelList.h>
#include <ImfDoubleAttribute.h>
#include <ImfFloatAttribute.h>
#include <ImfFrameBuffer.h>
#include <ImfInputPart.h>
#include <ImfIntAttribute.h>
#include <ImfRgbaFile.h>
#include <ImfStringAttribute.h>

#include <algorithm>
#include <array>
#include <tuple>

namespace parhelion {

namespace {

constexpr float first_inexact_uint = 16777216.0f; ///< 2^24

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
    return read_refusing(source, [&] {
        check_header(source);
        return read_checked(source);
    });
}

} // namespace

Image read_exr(const std::string& file) { return read_source(open_exr(file)); }

Image parse_exr(std::string_view bytes, const std::string& name) {
    return read_source(exr_in_memory(bytes, name));
}

} // namespace parhelion
