// Amounts of memory on the command line.
#include "host/commands/byte_size.h"

#include "host/error.h"
#include "host/scene/text.h"

#include <fmt/format.h>

#include <charconv>
#include <map>

namespace parhelion {

std::uint64_t parse_byte_size(const std::string& option, const std::string& text) {
    static const std::map<std::string, double> units{
        {"", 1}, {"K", 0x1p10}, {"M", 0x1p20}, {"G", 0x1p30}, {"T", 0x1p40}};
    double value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    const auto unit = units.find(std::string(end, text.data() + text.size()));
    const double bytes = unit == units.end() ? -1 : value * unit->second;
    constexpr double most = 0x1p50;
    if (error != std::errc() || !(bytes >= 1 && bytes <= most)) // what is no number neither
        throw InputError(fmt::format(
            "{}: found {}; accepted: an amount of memory, as 512M, 2G or 1.5G, up to {:.0f}T",
            option, in_quotes(text), most / 0x1p40));
    return static_cast<std::uint64_t>(bytes);
}

} // namespace parhelion
