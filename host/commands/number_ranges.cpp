// Many numbers in one text of the command line: frames, and values of a sweep.
#include "host/commands/number_ranges.h"

#include "host/error.h"
#include "host/scene/text.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cstdlib>
#include <optional>
#include <set>
#include <string_view>

namespace parhelion {
namespace {

constexpr std::int64_t last_frame = 999'999'999;

/// Reads a number at the start of `text` and takes it away.
std::optional<std::int64_t> take_integer(std::string_view& text) {
    std::int64_t value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc{}) return std::nullopt;
    text.remove_prefix(static_cast<std::size_t>(end - text.data()));
    return value;
}

bool take(std::string_view& text, char c) {
    if (text.empty() || text.front() != c) return false;
    text.remove_prefix(1);
    return true;
}

struct FrameRange {
    std::int64_t first = 0, last = 0, step = 1;

    std::size_t count() const {
        return static_cast<std::size_t>(std::abs(last - first) / step) + 1;
    }
};

/// Nothing for what is none.
std::optional<FrameRange> frame_range(std::string_view text) {
    FrameRange range;
    const auto frame = [&](std::int64_t& to) {
        const std::optional<std::int64_t> value = take_integer(text);
        to = value.value_or(0);
        return value && std::abs(to) <= last_frame;
    };
    if (!frame(range.first)) return std::nullopt;
    range.last = range.first;
    if (text.empty()) return range;
    if (!take(text, '-') || !frame(range.last)) return std::nullopt;
    if (text.empty()) return range;
    if (!take(text, 'x') || !frame(range.step) || range.step < 1 || !text.empty())
        return std::nullopt;
    return range;
}

[[noreturn]] void refuse_count(const std::string& what) {
    throw InputError(
        fmt::format("{}: there are too many (accepted: up to {})", what, most_renders));
}

/// A number as it is written: digits / 10^places.
struct Decimal {
    std::int64_t digits = 0;
    int places = 0;
};

constexpr int most_digits = 17;
constexpr std::int64_t digits_limit = 100'000'000'000'000'000; // as many

/// Nothing for a text that is no number, and where digits are more than can be counted with.
std::optional<Decimal> decimal(std::string_view text) {
    if (!parse_number(text)) return std::nullopt;
    Decimal value;
    const bool negative = take(text, '-');
    if (!negative) take(text, '+');
    bool behind_point = false;
    for (; !text.empty() && text.front() != 'e' && text.front() != 'E'; text.remove_prefix(1)) {
        if (text.front() == '.') {
            behind_point = true;
            continue;
        }
        if (text.front() < '0' || text.front() > '9' || value.digits >= digits_limit / 10)
            return std::nullopt;
        value.digits = 10 * value.digits + (text.front() - '0');
        value.places += behind_point ? 1 : 0;
    }
    if (!text.empty()) {
        text.remove_prefix(1);
        take(text, '+');
        value.places -= static_cast<int>(take_integer(text).value_or(0));
    }
    if (value.digits == 0) return Decimal{};
    if (negative) value.digits = -value.digits;
    return value;
}

/// The same with so many places, which are no fewer. Nothing where digits are too many.
std::optional<std::int64_t> with_places(Decimal value, int places) {
    if (value.digits == 0) return 0;
    if (places - value.places > most_digits) return std::nullopt;
    for (; value.places < places; value.places++) {
        value.digits *= 10;
        if (std::abs(value.digits) >= digits_limit) return std::nullopt;
    }
    return value.digits;
}

/// Of "from:step:to"; nothing for another text.
std::optional<std::array<std::string_view, 3>> three_numbers(std::string_view text) {
    const std::size_t first = text.find(':'), second = text.find(':', first + 1);
    if (first == text.npos || second == text.npos || text.find_first_of(" \t\n") != text.npos)
        return std::nullopt;
    const std::array parts{text.substr(0, first), text.substr(first + 1, second - first - 1),
                           text.substr(second + 1)};
    const auto is_number = [](std::string_view part) { return parse_number(part).has_value(); };
    if (!std::all_of(parts.begin(), parts.end(), is_number)) return std::nullopt;
    return parts;
}

/// In units of the last place that any of them has, and how many places those are. Nothing where
/// digits are too many.
std::optional<std::array<std::int64_t, 4>> counted(const std::array<std::string_view, 3>& parts) {
    std::array<Decimal, 3> values{};
    int places = 0;
    for (std::size_t i = 0; i < parts.size(); i++) {
        const std::optional<Decimal> value = decimal(parts[i]);
        if (!value) return std::nullopt;
        values[i] = *value;
        places = std::max(places, value->places);
    }
    std::array<std::int64_t, 4> numbers{0, 0, 0, places};
    for (std::size_t i = 0; i < parts.size(); i++) {
        const std::optional<std::int64_t> digits = with_places(values[i], places);
        if (!digits) return std::nullopt;
        numbers[i] = *digits;
    }
    return numbers;
}

/// As short as it can be written.
std::string text_of(std::int64_t digits, int places) {
    for (; places > 0 && digits % 10 == 0; places--)
        digits /= 10;
    std::string text = fmt::format("{:0{}}", std::abs(digits), places + 1);
    if (places > 0) text.insert(text.size() - static_cast<std::size_t>(places), ".");
    return (digits < 0 ? "-" : "") + text;
}

} // namespace

std::vector<std::int64_t> parse_frames(const std::string& text) {
    const std::string what = "--frames " + in_quotes(text);
    std::vector<std::int64_t> frames;
    std::set<std::int64_t> known;
    for (std::string_view rest = text;;) {
        const std::size_t comma = rest.find(',');
        const std::optional<FrameRange> range = frame_range(rest.substr(0, comma));
        if (!range)
            throw InputError(fmt::format("{}: {} is none (accepted: frames of up to nine digits "
                                         "and ranges, as 7, 1-10, 1,3,7-20, 1-100x10 or 10-1)",
                                         what, in_quotes(rest.substr(0, comma))));
        if (range->count() > most_renders - frames.size()) refuse_count(what);
        const std::int64_t step = range->first <= range->last ? range->step : -range->step;
        for (std::size_t i = 0; i < range->count(); i++) {
            frames.push_back(range->first + static_cast<std::int64_t>(i) * step);
            if (!known.insert(frames.back()).second)
                throw InputError(fmt::format("{}: has frame {} twice", what, frames.back()));
        }
        if (comma == std::string_view::npos) return frames;
        rest.remove_prefix(comma + 1);
    }
}

std::vector<std::string> parse_sweep(const std::string& name, const std::string& text) {
    const std::optional<std::array<std::string_view, 3>> parts = three_numbers(text);
    if (!parts) return {};
    const std::string what = fmt::format("{}={}", name, text);
    const std::optional<std::array<std::int64_t, 4>> numbers = counted(*parts);
    if (!numbers)
        throw InputError(fmt::format("{}: its numbers have too many digits (accepted: {} in all "
                                     "places that any of them has)",
                                     what, most_digits));
    const auto [from, step, to, places] = *numbers;
    if (step == 0 || (to != from && (to > from) != (step > 0)))
        throw InputError(what + ": has no value (accepted: from:step:to, with a step that leads "
                                "from the first to the last)");
    const auto steps = static_cast<std::size_t>((to - from) / step);
    if (steps >= most_renders) refuse_count(what);
    std::vector<std::string> all;
    all.reserve(steps + 1);
    for (std::size_t i = 0; i <= steps; i++)
        all.push_back(
            text_of(from + static_cast<std::int64_t>(i) * step, static_cast<int>(places)));
    return all;
}

} // namespace parhelion
