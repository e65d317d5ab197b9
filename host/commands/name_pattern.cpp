// Names of files that are made of what a render is: out-$frame.exr.
#include "host/commands/name_pattern.h"

#include "host/error.h"
#include "host/scene/text.h"

#include <fmt/format.h>

#include <string_view>

namespace parhelion {
namespace {

/// A piece at the start of a pattern: how long it is, and what stands in its place. No length:
/// none.
struct Piece {
    std::size_t length = 0;
    std::string text{};
};

Piece named_value(const std::string& option, std::string_view pattern, const NameValues& values) {
    if (pattern[0] != '$') return {};
    const std::pair<std::string, std::string>* best = nullptr;
    std::string names;
    for (const auto& value : values.values) {
        names += (names.empty() ? "$" : ", $") + value.first;
        if (pattern.substr(1).starts_with(value.first) &&
            (!best || value.first.size() > best->first.size()))
            best = &value;
    }
    if (!best) {
        const std::size_t end = pattern.find_first_not_of(
            "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_", 1);
        throw InputError(fmt::format("{}: there is no value for {} (accepted: {}; \\$ writes a $)",
                                     option, in_quotes(pattern.substr(0, end)), names));
    }
    return {1 + best->first.size(), best->second};
}

/// "####": sign, and that many digits at least.
Piece hashes(std::string_view pattern, std::int64_t frame) {
    const std::size_t length = std::min(pattern.find_first_not_of('#'), pattern.size());
    return {length, fmt::format("{}{:0{}}", frame < 0 ? "-" : "", std::abs(frame), length)};
}

/// "%d", "%04d": that many characters at least.
Piece conversion(std::string_view pattern, std::int64_t frame) {
    if (pattern.starts_with("%d")) return {2, fmt::format("{}", frame)};
    if (pattern.size() < 4 || !pattern.starts_with("%0") || pattern[2] < '1' || pattern[2] > '9' ||
        pattern[3] != 'd')
        return {};
    return {4, fmt::format("{:0{}}", frame, pattern[2] - '0')};
}

Piece piece_at(const std::string& option, std::string_view pattern, const NameValues& values) {
    if (pattern[0] == '$') return named_value(option, pattern, values);
    if (values.frame && pattern[0] == '#') return hashes(pattern, *values.frame);
    if (values.frame && pattern[0] == '%') return conversion(pattern, *values.frame);
    const std::string_view special = values.frame ? "$#%" : "$";
    if (pattern[0] == '\\' && pattern.size() > 1 && special.find(pattern[1]) != special.npos)
        return {2, std::string(1, pattern[1])};
    return {};
}

} // namespace

std::string expanded_name(const std::string& option, const std::string& pattern,
                          const NameValues& values) {
    std::string name;
    for (std::string_view rest = pattern; !rest.empty();) {
        Piece piece = piece_at(option, rest, values);
        if (piece.length == 0) piece = {1, std::string(1, rest[0])};
        name += piece.text;
        rest.remove_prefix(piece.length);
    }
    return name;
}

} // namespace parhelion
