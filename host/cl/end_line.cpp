// The last line of a process that ends in a signal handler.
#include "host/cl/end_line.h"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>

namespace parhelion {
namespace {

/// `digits` digits of `value` at `place`.
char* put_digits(char* place, int value, int digits) {
    for (int i = digits - 1; i >= 0; i--, value /= 10)
        place[i] = static_cast<char>('0' + value % 10);
    return place + digits;
}

/// "2030-01-31T23:59:59.000Z ", as the log has it: by arithmetic, which libraries' calendars are
/// more than.
std::array<char, 25> time_stamp() {
    using namespace std::chrono;
    const auto now = floor<milliseconds>(system_clock::now());
    const auto midnight = floor<days>(now);
    const year_month_day day(midnight);
    const hh_mm_ss time(now - midnight);
    std::array<char, 25> text{};
    char* end = put_digits(text.data(), static_cast<int>(day.year()), 4);
    const auto next = [&end](char before, auto value, int digits) {
        *end = before;
        end = put_digits(end + 1, static_cast<int>(value), digits);
    };
    next('-', static_cast<unsigned>(day.month()), 2);
    next('-', static_cast<unsigned>(day.day()), 2);
    next('T', time.hours().count(), 2);
    next(':', time.minutes().count(), 2);
    next(':', time.seconds().count(), 2);
    next('.', time.subseconds().count(), 3);
    *end = 'Z';
    end[1] = ' ';
    return text;
}

} // namespace

void put(int file, std::string_view text) {
    while (!text.empty()) {
        const ssize_t written = write(file, text.data(), text.size());
        if (written <= 0) return;
        text.remove_prefix(static_cast<std::size_t>(written));
    }
}

void EndLine::add(std::string_view text) {
    for (const char c : text.substr(0, text_.size() - size_))
        text_[size_++] = static_cast<unsigned char>(c) < ' ' ? ' ' : c;
}

void EndLine::tell(const LastPlaces& places) {
    if (!places.log_file.empty()) tell_log(places.log_file.c_str());
    if (places.as_json) {
        tell_as_json(places.standard_error);
    } else {
        put(places.standard_error, {text_.data(), size_});
        put(places.standard_error, "\n");
    }
}

void EndLine::tell_log(const char* name) const {
    const int file = open(name, O_WRONLY | O_APPEND | O_CLOEXEC);
    if (file < 0) return;
    const std::array<char, 25> stamp = time_stamp();
    put(file, {stamp.data(), stamp.size()});
    put(file, {text_.data(), size_});
    put(file, "\n");
    close(file);
}

/// What JSON would have to escape is replaced.
void EndLine::tell_as_json(int file) {
    const auto end = text_.begin() + static_cast<std::ptrdiff_t>(size_);
    std::replace(text_.begin(), end, '"', '\'');
    std::replace(text_.begin(), end, '\\', '/');
    std::replace_if(
        text_.begin(), end, [](char c) { return static_cast<unsigned char>(c) >= 0x7f; }, '?');
    put(file, R"({"state":"note","message":")");
    put(file, {text_.data(), size_});
    put(file, "\"}\n");
}

} // namespace parhelion
