// Reading numbers out of text the same way in every locale, and quoting foreign text in one-line
// messages.
#include "host/scene/text.h"

#include <algorithm>
#include <charconv>
#include <cmath>

namespace parhelion {

namespace {

constexpr std::string_view blanks = " \t\r\n";
constexpr std::size_t longest_quote = 80;

std::string_view trimmed(std::string_view text) {
    const std::size_t first = text.find_first_not_of(blanks);
    if (first == std::string_view::npos) return {};
    return text.substr(first, text.find_last_not_of(blanks) - first + 1);
}

/// A leading plus is common in data files; from_chars does not take it.
std::string_view without_plus(std::string_view text) {
    const bool plus = text.size() > 1 && text[0] == '+' && text[1] != '-' && text[1] != '+';
    return plus ? text.substr(1) : text;
}

template<typename T>
std::optional<T> parse_whole(std::string_view text) {
    text = without_plus(trimmed(text));
    T value{};
    const char* const end = text.data() + text.size();
    const auto [stop, error] = std::from_chars(text.data(), end, value);
    if (error != std::errc{} || stop != end) return std::nullopt;
    return value;
}

} // namespace

std::optional<double> parse_number(std::string_view text) {
    const std::optional<double> value = parse_whole<double>(text);
    return value && std::isfinite(*value) ? value : std::nullopt;
}

std::optional<std::int64_t> parse_integer(std::string_view text) {
    return parse_whole<std::int64_t>(text);
}

std::vector<std::string_view> split(std::string_view text, std::string_view separators) {
    std::vector<std::string_view> pieces;
    std::size_t start = text.find_first_not_of(separators);
    while (start != std::string_view::npos) {
        const std::size_t end = std::min(text.find_first_of(separators, start), text.size());
        pieces.push_back(text.substr(start, end - start));
        start = text.find_first_not_of(separators, end);
    }
    return pieces;
}

std::string in_quotes(std::string_view text) {
    return "\"" + as_one_line(std::string(text.substr(0, longest_quote))) +
           (text.size() > longest_quote ? "...\"" : "\"");
}

std::string lower_case(std::string_view text) {
    std::string result(text);
    for (char& c : result)
        if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
    return result;
}

void refuse(const SourceLocation& place, const std::string& message) {
    throw InputError(place.to_string() + ": " + message);
}

} // namespace parhelion
