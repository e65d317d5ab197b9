// OpenEXR files as texels: halves stay halves.
#include "host/image/exr_checks.h"
#include "host/image/texel_formats.h"

#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfInputPart.h>
#include <ImfVersion.h>

#include <algorithm>
#include <new>
#include <vector>

namespace parhelion {

namespace {

/// Names of the channels that are read: R, G, B, or Y.
std::vector<std::string> texel_channels(const ExrSource& source, const Imf::Header& header) {
    const Imf::ChannelList& list = header.channels();
    if (list.findChannel("R") && list.findChannel("G") && list.findChannel("B"))
        return {"R", "G", "B"};
    if (list.findChannel("Y") && !is_luminance_chroma(header)) return {"Y"};
    std::string found;
    for (auto i = list.begin(); i != list.end(); ++i)
        found += (found.empty() ? "" : ", ") + std::string(i.name());
    source.refuse("has the channels " + found + " (accepted: R, G, B; or Y)");
}

TexelLayout layout_of(const ExrSource& source, const ImageBytes& file, const Imf::Header& header) {
    TexelLayout layout;
    const auto [width, height] = box_size(header.dataWindow());
    set_size(file, width, height, layout);
    const std::vector<std::string> names = texel_channels(source, header);
    layout.channels = static_cast<int>(names.size());
    const bool halves = std::all_of(names.begin(), names.end(), [&](const std::string& name) {
        return header.channels()[name.c_str()].type == Imf::HALF;
    });
    layout.component = halves ? TexelComponent::half : TexelComponent::single;
    return layout;
}

/// Into interleaved texels, a band of rows at a time.
void read_rows(const ExrSource& source, Imf::MultiPartInputFile& input, const TexelLayout& layout,
               std::byte* to) {
    Imf::InputPart part(input, 0);
    const Imath::V2i corner = part.header().dataWindow().min;
    const std::vector<std::string> names = texel_channels(source, part.header());
    const std::size_t row_bytes = layout.width * layout.texel_bytes();
    const Imf::PixelType type = layout.component == TexelComponent::half ? Imf::HALF : Imf::FLOAT;
    for (int first = 0; first < layout.height; first += band_rows) {
        const int rows = std::min(band_rows, layout.height - first);
        Imf::FrameBuffer frame;
        for (std::size_t c = 0; c < names.size(); ++c)
            frame.insert(names[c], Imf::Slice::Make(
                                       type, to + first * row_bytes + c * layout.component_bytes(),
                                       Imath::V2i(corner.x, corner.y + first), layout.width, rows,
                                       layout.texel_bytes(), row_bytes));
        part.setFrameBuffer(frame);
        part.readPixels(corner.y + first, corner.y + first + rows - 1);
    }
}

/// Calls use(source, input), what the library throws as InputError.
template<class Use>
auto with_checked(const ImageBytes& file, Use use) {
    const ExrSource source = exr_in_memory(file.bytes, file.name);
    return read_refusing(source, [&] {
        check_header(source);
        Imf::MultiPartInputFile input(*source.stream, 0, false);
        check_part(source, input, 0);
        return use(source, input);
    });
}

} // namespace

bool is_openexr(const ImageBytes& file) {
    return file.bytes.size() >= 4 && Imf::isImfMagic(file.bytes.data());
}

TexelLayout layout_of_openexr(const ImageBytes& file) {
    return with_checked(file, [&](const ExrSource& source, const Imf::MultiPartInputFile& input) {
        return layout_of(source, file, input.header(0));
    });
}

void read_openexr(const ImageBytes& file, const TexelLayout& layout, std::span<std::byte> to) {
    with_checked(file, [&](const ExrSource& source, Imf::MultiPartInputFile& input) {
        read_rows(source, input, layout, to.data());
    });
}

} // namespace parhelion
