// TGA files (Truevision 1989) as texels: with a palette, of colours or grey, plain or in runs.
#include "host/image/texel_formats.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <vector>

namespace parhelion {

namespace {

using Rgb8 = std::array<std::uint8_t, 3>;

enum TgaType { with_palette = 1, of_colors = 2, grey = 3, in_runs = 8 };

struct Header {
    int type = 0; ///< a TgaType without in_runs
    bool runs = false;
    int palette_first = 0, palette_size = 0, palette_bits = 0;
    int width = 0, height = 0, bits = 0;
    bool from_top = false, from_right = false;
    std::size_t end = 0; ///< of the name, which stands behind the header
};

Header header_of(const ImageBytes& file) {
    ByteReader in(file);
    Header h;
    const std::size_t name_bytes = in.byte();
    const bool has_palette = in.byte() == 1;
    const int type = in.byte();
    h.runs = (type & in_runs) != 0;
    h.type = type & ~in_runs;
    h.palette_first = static_cast<int>(in.word16());
    h.palette_size = static_cast<int>(in.word16());
    h.palette_bits = in.byte();
    if (!has_palette) h.palette_size = 0;
    in.take(4); // where it stood on the screen
    h.width = static_cast<int>(in.word16());
    h.height = static_cast<int>(in.word16());
    h.bits = in.byte();
    const int descriptor = in.byte();
    h.from_right = (descriptor & 16) != 0;
    h.from_top = (descriptor & 32) != 0;
    in.take(name_bytes);
    h.end = in.at();
    return h;
}

bool has_color_bits(int bits) { return bits == 15 || bits == 16 || bits == 24 || bits == 32; }

/// Blue comes first; of 16 bits five are for each.
Rgb8 take_color(ByteReader& in, int bits) {
    if (bits > 16) {
        const std::string_view bgr = in.take(static_cast<std::size_t>(bits) / 8);
        return {static_cast<std::uint8_t>(bgr[2]), static_cast<std::uint8_t>(bgr[1]),
                static_cast<std::uint8_t>(bgr[0])};
    }
    const std::uint32_t word = in.word16();
    const auto widened = [&](int shift) {
        return static_cast<std::uint8_t>(((word >> shift & 31) * 255 + 15) / 31);
    };
    return {widened(10), widened(5), widened(0)};
}

std::vector<Rgb8> take_palette(ByteReader& in, const Header& h) {
    std::vector<Rgb8> palette(h.palette_size);
    for (Rgb8& color : palette)
        color = take_color(in, h.palette_bits);
    return palette;
}

Rgb8 take_texel(const ImageBytes& file, ByteReader& in, const Header& h,
                const std::vector<Rgb8>& palette) {
    if (h.type == of_colors) return take_color(in, h.bits);
    const int value = in.byte();
    if (h.type == grey) {
        const auto level = static_cast<std::uint8_t>(value);
        return {level, level, level};
    }
    const int entry = value - h.palette_first;
    if (entry < 0 || entry >= h.palette_size)
        file.refuse("a texel has color " + std::to_string(value) + ", which its palette lacks");
    return palette[entry];
}

void check(const ImageBytes& file, const Header& h) {
    const bool kind = h.type == with_palette || h.type == of_colors || h.type == grey;
    const bool bits = h.type == of_colors ? has_color_bits(h.bits) : h.bits == 8;
    const bool palette = h.type != with_palette || has_color_bits(h.palette_bits);
    if (!kind || !bits || !palette)
        file.refuse(
            "a TGA file of type " + std::to_string(h.type | (h.runs ? in_runs : 0)) + " with " +
            std::to_string(h.bits) +
            " bits a texel (accepted: types 1, 3, 9, 11 of 8 bits; 2, 10 of 15, 16, 24, 32)");
}

} // namespace

/// The header has no mark: by the name.
bool is_tga(const ImageBytes& file) {
    std::string end =
        file.name.substr(file.name.size() - std::min<std::size_t>(4, file.name.size()));
    std::transform(end.begin(), end.end(), end.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return end == ".tga";
}

TexelLayout layout_of_tga(const ImageBytes& file) {
    const Header h = header_of(file);
    check(file, h);
    TexelLayout layout;
    set_size(file, h.width, h.height, layout);
    layout.channels = h.type == grey ? 1 : 3;
    layout.srgb = true;
    // A run of up to 128 texels is two bytes at least.
    const std::size_t least = h.runs ? layout.texels() / 64 : layout.texels() * ((h.bits + 7) / 8);
    if (file.bytes.size() < least) file.refuse("ends before its last texel");
    return layout;
}

void read_tga(const ImageBytes& file, const TexelLayout& layout, std::span<std::byte> to) {
    const Header h = header_of(file);
    ByteReader in(file, h.end);
    const std::vector<Rgb8> palette = take_palette(in, h);
    Rgb8 texel{};
    int repeated = 0, single = 0;
    for (std::size_t n = 0; n < layout.texels(); ++n) {
        if (h.runs && repeated == 0 && single == 0) {
            const int packet = in.byte();
            (packet & 128 ? repeated : single) = (packet & 127) + 1;
            if (repeated > 0) texel = take_texel(file, in, h, palette);
        }
        if (repeated > 0) {
            --repeated;
        } else {
            single -= h.runs ? 1 : 0;
            texel = take_texel(file, in, h, palette);
        }
        const std::size_t row = n / layout.width, column = n % layout.width;
        const std::size_t y = h.from_top ? row : layout.height - 1 - row;
        const std::size_t x = h.from_right ? layout.width - 1 - column : column;
        std::memcpy(to.data() + (y * layout.width + x) * layout.channels, texel.data(),
                    layout.channels);
    }
}

} // namespace parhelion
