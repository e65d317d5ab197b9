// Radiance HDR files (Ward 1991, "Real Pixels") as texels: three mantissas and a common exponent.
#include "host/image/texel_formats.h"

#include <array>
#include <charconv>
#include <cmath>
#include <vector>

namespace parhelion {

namespace {

using Rgbe = std::array<std::uint8_t, 4>;

struct Header {
    std::int64_t width = 0, height = 0;
    std::size_t end = 0;
};

/// The number that `text` begins with, which it is taken from; -1: none.
std::int64_t take_number(std::string_view& text) {
    std::int64_t value = -1;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    text.remove_prefix(static_cast<std::size_t>(end - text.data()));
    return error == std::errc() ? value : -1;
}

Header header_of(const ImageBytes& file) {
    ByteReader in(file);
    for (std::string_view line = in.line(); !line.empty(); line = in.line())
        if (line.starts_with("FORMAT=") && line != "FORMAT=32-bit_rle_rgbe")
            file.refuse("a Radiance HDR file of " + std::string(line) +
                        " (accepted: FORMAT=32-bit_rle_rgbe)");
    std::string_view size = in.line();
    const std::string found(size);
    Header header;
    if (size.starts_with("-Y ")) {
        size.remove_prefix(3);
        header.height = take_number(size);
        if (size.starts_with(" +X ")) {
            size.remove_prefix(4);
            header.width = take_number(size);
        }
    }
    if (header.width < 0 || header.height < 0 || !size.empty() || header.width == 0)
        file.refuse("a Radiance HDR file of size \"" + found +
                    "\" (accepted: -Y <rows> +X <columns>)");
    header.end = in.at();
    return header;
}

/// One of a row's four components, by runs and by single values.
void read_runs(const ImageBytes& file, ByteReader& in, std::vector<Rgbe>& row, int component) {
    for (std::size_t x = 0; x < row.size();) {
        const std::uint8_t code = in.byte();
        const bool run = code > 128;
        const std::size_t count = run ? code - 128u : code;
        if (count == 0 || count > row.size() - x) file.refuse("a run of texels leaves its row");
        std::uint8_t value = run ? in.byte() : 0;
        for (std::size_t k = 0; k < count; ++k, ++x) {
            if (!run) value = in.byte();
            row[x][component] = value;
        }
    }
}

/// Texels one by one, where 1 1 1 n repeats the one before (the older way to write runs).
void read_plain(const ImageBytes& file, ByteReader& in, Rgbe first, std::vector<Rgbe>& row) {
    int shift = 0;
    Rgbe texel = first;
    for (std::size_t x = 0; x < row.size();) {
        const bool run = texel[0] == 1 && texel[1] == 1 && texel[2] == 1;
        if (run) {
            const std::size_t count = shift < 24 ? std::size_t{texel[3]} << shift : row.size();
            if (x == 0 || count > row.size() - x) file.refuse("a run of texels leaves its row");
            for (std::size_t k = 0; k < count; ++k, ++x)
                row[x] = row[x - 1];
            shift += 8;
        } else {
            row[x++] = texel;
            shift = 0;
        }
        if (x < row.size()) texel = {in.byte(), in.byte(), in.byte(), in.byte()};
    }
}

void read_row(const ImageBytes& file, ByteReader& in, std::vector<Rgbe>& row) {
    const Rgbe first{in.byte(), in.byte(), in.byte(), in.byte()};
    const bool by_component = first[0] == 2 && first[1] == 2 && first[2] < 128;
    if (!by_component || row.size() < 8 || row.size() > 32767)
        return read_plain(file, in, first, row);
    if ((first[2] << 8 | first[3]) != static_cast<int>(row.size()))
        file.refuse("a row has another length than the image");
    for (int component = 0; component < 4; ++component)
        read_runs(file, in, row, component);
}

} // namespace

bool is_rgbe(const ImageBytes& file) { return file.bytes.starts_with("#?"); }

TexelLayout layout_of_rgbe(const ImageBytes& file) {
    const Header header = header_of(file);
    TexelLayout layout;
    set_size(file, header.width, header.height, layout);
    layout.component = TexelComponent::single;
    // A row is at least four bytes, whatever its runs.
    if (file.bytes.size() - header.end < std::size_t{4} * layout.height)
        file.refuse("ends before its last texel");
    return layout;
}

void read_rgbe(const ImageBytes& file, const TexelLayout& layout, std::span<std::byte> to) {
    ByteReader in(file, header_of(file).end);
    std::vector<Rgbe> row(layout.width);
    for (std::size_t y = 0, at = 0; y < static_cast<std::size_t>(layout.height); ++y) {
        read_row(file, in, row);
        for (const Rgbe& texel : row)
            for (int c = 0; c < 3; ++c)
                put_float(to, at++, std::ldexp(static_cast<float>(texel[c]), texel[3] - 136));
    }
}

} // namespace parhelion
