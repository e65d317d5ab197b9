// What the user is told of samples that were not finite.
#include "host/commands/bad_sample_warning.h"

#include "host/commands/command_text.h"

#include <fmt/format.h>

#include <algorithm>

namespace parhelion {
namespace {

constexpr std::size_t places_told = 4; ///< the others are in --stats

/// With every option that has a say in what a sample is.
std::string trace_command(RenderCommand command, const BadSample& bad) {
    std::string text = fmt::format("parhelion render {} --pixel {},{} --sample {} --trace",
                                   quoted_for_shell(command.scene_file), bad.x, bad.y, bad.sample);
    for (const Option& option : render_options(command))
        if (option.rules.of_samples) text += given_option(option);
    return text;
}

std::string place(const BadSample& bad) {
    std::string bounce = bad.bounce < 0 ? "" : fmt::format(", bounce {}", bad.bounce);
    return fmt::format("pixel {},{} sample {}: {} ({}{})", bad.x, bad.y, bad.sample, bad.stage(),
                       bad.fault_name(), bounce);
}

} // namespace

std::string bad_sample_warning(const RenderCommand& command, const RenderReport& report) {
    if (report.non_finite_samples == 0) return "";
    std::string text =
        fmt::format("warning: {} samples were not finite; they were left out of the image:",
                    report.non_finite_samples);
    for (const FaultCount& fault : report.faults)
        text += fmt::format("{} {} in {} ({})", &fault == report.faults.data() ? "" : ",",
                            fault.samples, fault.stage, fault.fault);
    const std::vector<BadSample>& places = report.bad_samples;
    for (std::size_t i = 0; i < std::min(places.size(), places_told); i++)
        text += "\n  " + place(places[i]);
    if (places.size() > places_told) text += "\n  ... (--stats lists more)";
    if (!places.empty()) text += "\n  to follow the first: " + trace_command(command, places[0]);
    return text;
}

} // namespace parhelion
