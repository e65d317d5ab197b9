// What the user is told of values that the written file does not hold as they are.
#include "host/commands/misfit_warning.h"

#include "host/image/output.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace parhelion {
namespace {

constexpr std::size_t channels_told = 4; ///< the others are in --stats

/// What stands in the file for values that are not finite, and for those out of its range.
struct Stored {
    const char *range, *not_finite, *out_of_range;
};

Stored stored(const std::string& file, ComponentFormat component) {
    if (image_format(file) == ImageFormat::png) return {"8 bits", "shown in magenta", ""};
    switch (component) {
    case ComponentFormat::float16:
        return {"float16 (65504)", "kept",
                "infinite in the file; component_format float32 holds "
                "them"};
    case ComponentFormat::uint32:
        return {"uint32 (0 to 4294967295)", "0 or the nearest end of the range in the file",
                "the nearest end of the range in the file; component_format float32 holds them"};
    case ComponentFormat::float32:
        break;
    }
    return {"float32", "kept", ""};
}

/// The component of the first channel that has values out of its range; of the first, if none has.
ComponentFormat narrowest(const ExrOptions& written, const std::vector<Misfits>& channels) {
    for (const Misfits& m : channels)
        if (m.out_of_range > 0) return written.component_of(m.channel);
    return channels.empty() ? written.component : written.component_of(channels[0].channel);
}

std::string place(const Misfits& m) {
    std::string value = std::isnan(m.value) ? "no number" : fmt::format("{:g}", m.value);
    return fmt::format("{}: {} values, the first at pixel {},{}: {}", m.channel, m.count(), m.x,
                       m.y, value);
}

} // namespace

std::string misfit_warning(const std::string& file, const ExrOptions& written,
                           const RenderReport& report) {
    const std::vector<Misfits>& all = report.misfits;
    std::uint64_t not_finite = 0, out_of_range = 0;
    for (const Misfits& m : all)
        not_finite += m.not_finite, out_of_range += m.out_of_range;
    Stored as = stored(file, narrowest(written, all));
    std::string text;
    if (not_finite > 0)
        text += fmt::format("warning: {}: {} values of the image are not finite ({}):\n", file,
                            not_finite, as.not_finite);
    if (out_of_range > 0)
        text += fmt::format("warning: {}: {} values are beyond {} ({}):\n", file, out_of_range,
                            as.range, as.out_of_range);
    for (std::size_t i = 0; i < std::min(all.size(), channels_told); i++)
        text += "  " + place(all[i]) + '\n';
    if (all.size() > channels_told)
        text += fmt::format("  ... and {} channels more (--stats lists them)\n",
                            all.size() - channels_told);
    if (!text.empty()) text.pop_back();
    return text;
}

} // namespace parhelion
