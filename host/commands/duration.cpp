// Lengths of time on the command line.
#include "host/commands/duration.h"

#include "host/error.h"
#include "host/scene/text.h"

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <map>

namespace parhelion {

double parse_duration(const std::string& option, const std::string& text) {
    static const std::map<std::string, double> units{{"", 1}, {"s", 1}, {"m", 60}, {"h", 3600}};
    double value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    const auto unit = units.find(std::string(end, text.data() + text.size()));
    const double seconds = unit == units.end() ? -1 : value * unit->second;
    constexpr double most = 1e8; // three years
    if (error != std::errc() || !std::isfinite(seconds) || std::signbit(seconds) || seconds > most)
        throw InputError(fmt::format("{}: found {}; accepted: a time of 0 to {:.0e} s, as 90, 90s, "
                                     "1.5m or 2h",
                                     option, in_quotes(text), most));
    return seconds;
}

} // namespace parhelion
