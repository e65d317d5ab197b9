// PFM files (Debevec's portable float maps) as texels.
#include "host/image/texel_formats.h"

#include <charconv>
#include <cmath>

namespace parhelion {

namespace {

struct Header {
    int channels = 3;
    std::int64_t width = 0, height = 0;
    float scale = 0; ///< negative: the file is little-endian
    std::size_t end = 0;
};

/// The next word of the header, behind blanks and ends of lines.
std::string_view word(const ImageBytes& file, std::size_t& at) {
    const std::size_t begin = file.bytes.find_first_not_of(" \t\r\n", at);
    at = file.bytes.find_first_of(" \t\r\n", begin);
    if (begin == std::string_view::npos || at == std::string_view::npos)
        file.refuse("ends within its header");
    return file.bytes.substr(begin, at - begin);
}

template<class Number>
Number number(const ImageBytes& file, std::size_t& at) {
    const std::string_view text = word(file, at);
    Number value{};
    const char* const last = text.data() + text.size();
    const auto [end, error] = std::from_chars(text.data(), last, value);
    if (error != std::errc() || end != last)
        file.refuse("its header has \"" + std::string(text) + "\" where a number is wanted");
    return value;
}

Header header_of(const ImageBytes& file) {
    Header header;
    header.channels = file.bytes[1] == 'F' ? 3 : 1;
    std::size_t at = 2;
    header.width = number<std::int64_t>(file, at);
    header.height = number<std::int64_t>(file, at);
    header.scale = number<float>(file, at);
    if (!(std::fabs(header.scale) > 0.f) || !std::isfinite(header.scale))
        file.refuse("its header has a scale of " + std::to_string(header.scale));
    header.end = at + 1;
    return header;
}

float float_at(const char* bytes, bool little) {
    std::uint32_t bits = 0;
    for (int k = 0; k < 4; ++k)
        bits |= std::uint32_t{static_cast<std::uint8_t>(bytes[k])} << 8 * (little ? k : 3 - k);
    return std::bit_cast<float>(bits);
}

} // namespace

bool is_pfm(const ImageBytes& file) {
    const std::string_view& bytes = file.bytes;
    const bool named = bytes.starts_with("PF") || bytes.starts_with("Pf");
    return named && bytes.size() > 2 && (bytes[2] == '\n' || bytes[2] == ' ' || bytes[2] == '\r');
}

TexelLayout layout_of_pfm(const ImageBytes& file) {
    const Header header = header_of(file);
    TexelLayout layout;
    set_size(file, header.width, header.height, layout);
    layout.channels = header.channels;
    layout.component = TexelComponent::single;
    if (header.end > file.bytes.size() || file.bytes.size() - header.end < layout.bytes())
        file.refuse("ends before its last texel");
    return layout;
}

/// The bottom row comes first.
void read_pfm(const ImageBytes& file, const TexelLayout& layout, std::span<std::byte> to) {
    const Header header = header_of(file);
    const float scale = std::fabs(header.scale);
    const std::size_t row = static_cast<std::size_t>(layout.width) * layout.channels;
    ByteReader in(file, header.end);
    for (std::size_t y = layout.height; y-- > 0;) {
        const std::string_view bytes = in.take(row * sizeof(float));
        for (std::size_t k = 0; k < row; ++k)
            put_float(to, y * row + k,
                      scale * float_at(bytes.data() + k * sizeof(float), header.scale < 0));
    }
}

} // namespace parhelion
