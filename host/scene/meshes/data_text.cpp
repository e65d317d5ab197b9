// Text files of data, in whatever encoding and with whatever ends of lines programs write them.
#include "host/scene/meshes/data_text.h"

#include "host/scene/text.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <limits>

namespace parhelion {

namespace {

constexpr std::string_view little_mark = "\xff\xfe", big_mark = "\xfe\xff";

bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\v' || c == '\f'; }
bool is_line_end(char c) { return c == '\r' || c == '\n'; }

/// A backslash right before the end of a line.
bool is_continuation(std::string_view text, std::size_t i) {
    return text[i] == '\\' && i + 1 < text.size() && is_line_end(text[i + 1]);
}

/// Whether a decimal number that no double can hold is too small rather than too large: its first
/// digit that counts stands, with the exponent, behind the point.
bool is_tiny(std::string_view text) {
    const std::size_t e = std::min(text.find_first_of("eE"), text.size());
    const std::string_view digits = text.substr(0, e);
    const std::size_t first = digits.find_first_of("123456789");
    if (first == std::string_view::npos) return true;
    const std::size_t point = std::min(digits.find('.'), digits.size());
    const double places = static_cast<double>(point) - static_cast<double>(first);
    const std::string_view exponent = text.substr(std::min(e + 1, text.size()));
    if (exponent.empty()) return places < 0.0;
    if (const auto value = parse_integer(exponent))
        return places + static_cast<double>(*value) < 0.0;
    return exponent.starts_with('-'); // more digits than an integer holds
}

/// What Microsoft's libraries print for numbers that are none: "1.#QNAN", "-1.#IND00".
bool is_printed_nan(std::string_view rest) {
    constexpr std::array<std::string_view, 4> names = {"#QNAN", "#SNAN", "#IND", "#INF"};
    return std::any_of(names.begin(), names.end(),
                       [&](std::string_view name) { return rest.starts_with(name); });
}

} // namespace

bool is_utf16(std::string_view bytes, const SourceLocation& place) {
    using namespace std::string_view_literals;
    if (bytes.starts_with("\xff\xfe\0\0"sv) || bytes.starts_with("\0\0\xfe\xff"sv))
        refuse(place, "the text is UTF-32 (accepted: ASCII, UTF-8, UTF-16)");
    if (bytes.starts_with(little_mark) || bytes.starts_with(big_mark)) return true;
    return bytes.size() >= 4 && (bytes[0] == '\0') != (bytes[1] == '\0') &&
           (bytes[0] == '\0') == (bytes[2] == '\0') && (bytes[1] == '\0') == (bytes[3] == '\0');
}

std::string ascii_of_utf16(std::string_view bytes) {
    const bool big = bytes.starts_with(big_mark) || bytes.starts_with('\0');
    if (bytes.starts_with(big_mark) || bytes.starts_with(little_mark)) bytes.remove_prefix(2);
    std::string result;
    result.reserve(bytes.size() / 2);
    for (std::size_t i = 0; i + 1 < bytes.size(); i += 2) {
        const char high = bytes[i + (big ? 0 : 1)], low = bytes[i + (big ? 1 : 0)];
        const bool ascii = high == '\0' && static_cast<unsigned char>(low) < 0x80;
        result.push_back(ascii ? low : '?');
    }
    return result;
}

std::string_view without_utf8_mark(std::string_view bytes) {
    constexpr std::string_view mark = "\xef\xbb\xbf";
    return bytes.starts_with(mark) ? bytes.substr(mark.size()) : bytes;
}

std::optional<double> parse_real(std::string_view text) {
    if (text.size() > 1 && text[0] == '+' && text[1] != '-' && text[1] != '+')
        text.remove_prefix(1); // from_chars takes no plus
    double value = 0.0;
    const char* const end = text.data() + text.size();
    const auto [stop, error] = std::from_chars(text.data(), end, value);
    if (error == std::errc::invalid_argument) return std::nullopt;
    if (stop != end) {
        const std::string_view rest(stop, static_cast<std::size_t>(end - stop));
        if (!is_printed_nan(rest)) return std::nullopt;
        return std::numeric_limits<double>::quiet_NaN();
    }
    if (error == std::errc{}) return value;
    const double size = is_tiny(text) ? 0.0 : std::numeric_limits<double>::infinity();
    return text.starts_with('-') ? -size : size;
}

void LineReader::find_end(std::size_t from) {
    if (!feed_known_ || feed_ < from) {
        feed_ = std::min(text_.find('\n', from), text_.size());
        feed_known_ = true;
    }
    end_ = std::min(text_.substr(0, feed_).find('\r', from), feed_);
    next_ = end_ + (end_ < feed_ && end_ + 1 == feed_ && feed_ < text_.size() ? 2 : 1);
    if (lines_ < std::numeric_limits<int>::max()) ++lines_;
}

bool LineReader::next() {
    if (next_ >= text_.size()) return false;
    start_ = next_;
    find_end(start_);
    number_ = lines_;
    return true;
}

bool LineReader::join_continued() {
    if (end_ == start_ || text_[end_ - 1] != '\\' || next_ >= text_.size()) return false;
    find_end(next_);
    return true;
}

void split_words(std::string_view line, std::vector<std::string_view>& words) {
    words.clear();
    const auto separates = [&](std::size_t i) {
        return is_blank(line[i]) || is_line_end(line[i]) || is_continuation(line, i);
    };
    for (std::size_t i = 0; i < line.size();) {
        const std::size_t start = i;
        while (i < line.size() && !separates(i))
            ++i;
        if (i > start) words.push_back(line.substr(start, i - start));
        ++i;
    }
    // A backslash at the end of the file.
    if (!words.empty() && words.back() == "\\") words.pop_back();
}

} // namespace parhelion
