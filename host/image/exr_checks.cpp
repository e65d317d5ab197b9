// Checks of an EXR file's header before memory is taken for its pixels.
#include "host/image/exr_checks.h"

#include <ImfChannelList.h>
#include <ImfPartType.h>
#include <ImfTileDescription.h>

namespace parhelion {

std::pair<std::int64_t, std::int64_t> box_size(const Imath::Box2i& box) {
    return {std::int64_t(box.max.x) - box.min.x + 1, std::int64_t(box.max.y) - box.min.y + 1};
}

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

bool is_luminance_chroma(const Imf::Header& header) {
    const Imf::ChannelList& channels = header.channels();
    return channels.findChannel("Y") && channels.findChannel("RY") && channels.findChannel("BY");
}

namespace {

constexpr std::int64_t largest_edge = 1 << 20;  ///< pixels
constexpr std::int64_t largest_image = 1 << 30; ///< values in all channels together: 4 GiB
constexpr std::int64_t largest_tile = 1 << 26;  ///< values in all channels of one tile

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

} // namespace

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

} // namespace parhelion
