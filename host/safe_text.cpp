// Text of unknown origin, fit for a terminal and for one line.
#include "host/safe_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>

namespace parhelion {
namespace {

struct Character {
    std::size_t bytes = 1;
    std::uint32_t code = 0;
    bool valid = false; ///< else one byte that is no UTF-8
};

/// The first character: shortest forms only, no surrogates, up to U+10FFFF (The Unicode Standard
/// 15.0, table 3-7).
Character first_character(std::string_view text) {
    const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
    const unsigned lead = byte(0);
    if (lead < 0x80) return {1, lead, true};
    const std::size_t bytes = lead >= 0xf0 ? 4 : lead >= 0xe0 ? 3 : 2;
    if (lead < 0xc2 || lead > 0xf4 || text.size() < bytes) return {};
    std::uint32_t code = lead & (0x7fu >> bytes);
    for (std::size_t i = 1; i < bytes; i++) {
        if ((byte(i) & 0xc0u) != 0x80u) return {};
        code = code << 6 | (byte(i) & 0x3fu);
    }
    const std::uint32_t least = bytes == 4 ? 0x10000 : bytes == 3 ? 0x800 : 0x80;
    if (code < least || code > 0x10ffff || (code >= 0xd800 && code < 0xe000)) return {};
    return {bytes, code, true};
}

bool is_obeyed(std::uint32_t code) {
    const auto within = [code](std::uint32_t first, std::uint32_t last) {
        return code >= first && code <= last;
    };
    return code < 0x20 || within(0x7f, 0x9f) || within(0x2028, 0x202e) || within(0x2066, 0x2069);
}

std::string escape(std::uint32_t code) {
    switch (code) {
    case '\n':
        return "\\n";
    case '\r':
        return "\\r";
    case '\t':
        return "\\t";
    default:
        return fmt::format("\\u{:04x}", code);
    }
}

std::string escaped(std::string_view text, std::string_view kept) {
    std::string out;
    out.reserve(text.size());
    while (!text.empty()) {
        const Character c = first_character(text);
        const std::string_view piece = text.substr(0, c.bytes);
        if (!c.valid)
            out += fmt::format("\\x{:02x}", static_cast<unsigned char>(piece[0]));
        else if (is_obeyed(c.code) && kept.find(piece) == std::string_view::npos)
            out += escape(c.code);
        else
            out += piece;
        text.remove_prefix(c.bytes);
    }
    return out;
}

} // namespace

std::string safe_text(std::string_view text) { return escaped(text, "\n\t"); }

std::string as_one_line(std::string_view text) { return escaped(text, ""); }

std::string as_lines(const std::vector<std::string>& texts) {
    std::string lines;
    for (const std::string& text : texts)
        lines += (lines.empty() ? "" : "\n") + as_one_line(text);
    return lines;
}

} // namespace parhelion
