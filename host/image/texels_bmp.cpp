// BMP files (Windows bitmaps) as texels: with a palette, or 24 or 32 bits a texel.
#include "host/image/texel_formats.h"

#include <array>
#include <vector>

namespace parhelion {

namespace {

using Rgb8 = std::array<std::uint8_t, 3>;

enum Compression { plain = 0, by_masks = 3 };

struct Header {
    std::size_t texels = 0;  ///< where they begin
    std::size_t palette = 0; ///< likewise
    std::size_t colors = 0;  ///< of the palette
    int entry_bytes = 4;
    std::int64_t width = 0, height = 0;
    bool from_top = false;
    int bits = 0;
    std::uint32_t compression = plain;
    std::array<int, 3> at{2, 1, 0}; ///< bytes of a texel that hold red, green, blue

    std::size_t row_bytes() const { return (static_cast<std::size_t>(width) * bits + 31) / 32 * 4; }
};

/// The byte of a texel that a mask takes.
int byte_of(const ImageBytes& file, std::uint32_t mask) {
    for (int k = 0; k < 4; ++k)
        if (mask == 0xffu << 8 * k) return k;
    file.refuse("a BMP file with masks of other than whole bytes");
}

/// Behind the number of bytes of a header of 40 or more.
void read_long_header(const ImageBytes& file, ByteReader& in, Header& h) {
    h.width = static_cast<std::int32_t>(in.word32());
    h.height = static_cast<std::int32_t>(in.word32());
    h.from_top = h.height < 0;
    if (h.from_top) h.height = -h.height;
    in.word16();
    h.bits = static_cast<int>(in.word16());
    h.compression = in.word32();
    in.take(12); // bytes of all texels, texels a metre
    h.colors = in.word32();
    in.word32();
    if (h.compression == by_masks)
        for (int& at : h.at)
            at = byte_of(file, in.word32());
}

Header header_of(const ImageBytes& file) {
    ByteReader in(file, 10);
    Header h;
    h.texels = in.word32();
    const std::size_t bytes = in.word32();
    h.palette = 14 + bytes;
    if (bytes == 12) { // of OS/2
        h.width = in.word16();
        h.height = in.word16();
        in.word16();
        h.bits = static_cast<int>(in.word16());
        h.entry_bytes = 3;
    } else {
        if (bytes < 40)
            file.refuse("a BMP file with a header of " + std::to_string(bytes) + " bytes");
        read_long_header(file, in, h);
    }
    const bool small = h.bits == 1 || h.bits == 4 || h.bits == 8;
    if (h.colors == 0 && small) h.colors = std::size_t{1} << h.bits;
    const bool whole = h.bits == 24 || h.bits == 32;
    if (!(h.compression == plain && (small || whole)) &&
        !(h.compression == by_masks && h.bits == 32))
        file.refuse("a BMP file of " + std::to_string(h.bits) + " bits a texel and compression " +
                    std::to_string(h.compression) + " (accepted: 1, 4, 8, 24, 32 bits, 0; 32, 3)");
    if (small && h.colors > 256)
        file.refuse("a palette of " + std::to_string(h.colors) + " colors");
    return h;
}

std::vector<Rgb8> palette_of(const ImageBytes& file, const Header& h) {
    std::vector<Rgb8> palette(h.bits <= 8 ? h.colors : 0);
    ByteReader in(file, h.palette);
    for (Rgb8& color : palette) {
        const std::string_view bgr = in.take(h.entry_bytes);
        for (int c = 0; c < 3; ++c)
            color[c] = static_cast<std::uint8_t>(bgr[2 - c]);
    }
    return palette;
}

Rgb8 texel_of(const ImageBytes& file, const Header& h, const std::vector<Rgb8>& palette,
              std::string_view row, std::size_t x) {
    const auto byte = [&](std::size_t at) { return static_cast<std::uint8_t>(row[at]); };
    if (h.bits > 8) {
        const std::size_t first = x * (h.bits / 8);
        return {byte(first + h.at[0]), byte(first + h.at[1]), byte(first + h.at[2])};
    }
    const std::size_t bit = x * h.bits;
    const int shift = 8 - h.bits - static_cast<int>(bit % 8);
    const std::size_t entry = byte(bit / 8) >> shift & ((1 << h.bits) - 1);
    if (entry >= palette.size())
        file.refuse("a texel has color " + std::to_string(entry) + ", which its palette lacks");
    return palette[entry];
}

} // namespace

bool is_bmp(const ImageBytes& file) { return file.bytes.starts_with("BM"); }

TexelLayout layout_of_bmp(const ImageBytes& file) {
    const Header h = header_of(file);
    TexelLayout layout;
    set_size(file, h.width, h.height, layout);
    layout.srgb = true;
    if (h.texels > file.bytes.size() ||
        file.bytes.size() - h.texels < h.row_bytes() * layout.height)
        file.refuse("ends before its last texel");
    return layout;
}

void read_bmp(const ImageBytes& file, const TexelLayout& layout, std::span<std::byte> to) {
    const Header h = header_of(file);
    const std::vector<Rgb8> palette = palette_of(file, h);
    ByteReader in(file, h.texels);
    for (std::size_t n = 0; n < static_cast<std::size_t>(layout.height); ++n) {
        const std::size_t y = h.from_top ? n : layout.height - 1 - n;
        const std::string_view row = in.take(h.row_bytes());
        for (std::size_t x = 0; x < static_cast<std::size_t>(layout.width); ++x) {
            const Rgb8 texel = texel_of(file, h, palette, row, x);
            std::memcpy(to.data() + (y * layout.width + x) * 3, texel.data(), 3);
        }
    }
}

} // namespace parhelion
