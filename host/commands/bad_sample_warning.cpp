// What the user is told of samples that were not finite.
#include "host/commands/bad_sample_warning.h"

#include <fmt/format.h>

#include <algorithm>

namespace parhelion {
namespace {

constexpr std::size_t places_told = 4; ///< the others are in --stats

/// As a shell reads it.
std::string quoted(const std::string& text) {
    constexpr const char* plain = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789"
                                  "-_./=,:+@%";
    if (!text.empty() && text.find_first_not_of(plain) == std::string::npos) return text;
    std::string out = "'";
    for (char c : text)
        out += c == '\'' ? std::string("'\\''") : std::string(1, c);
    return out + "'";
}

void add(std::string& text, const char* option, const std::optional<std::string>& value) {
    if (value) text += fmt::format(" {} {}", option, quoted(*value));
}
template<class Number>
void add(std::string& text, const char* option, const std::optional<Number>& value) {
    if (value) text += fmt::format(" {} {}", option, *value);
}

/// With every option that has a say in what a sample is.
std::string trace_command(const RenderCommand& c, const BadSample& bad) {
    std::string text = fmt::format("parhelion render {} --pixel {},{} --sample {} --trace",
                                   quoted(c.scene_file), bad.x, bad.y, bad.sample);
    for (const std::string& definition : c.definitions)
        text += " -D " + quoted(definition);
    add(text, "--size", c.size);
    add(text, "--spp", c.samples);
    add(text, "--seed", c.seed);
    add(text, "--sampler", c.sampler);
    add(text, "--filter-by", c.filter_method);
    add(text, "--integrator", c.integrator);
    add(text, "--max-depth", c.max_depth);
    add(text, "--rr-depth", c.rr_depth);
    if (!c.next_event) text += " --no-next-event";
    add(text, "--shading-normals", c.shading_normals);
    if (!c.energy_compensation) text += " --no-energy-compensation";
    if (!c.aovs.empty()) text += " --aov " + quoted(fmt::format("{}", fmt::join(c.aovs, ",")));
    if (c.allow_outside) text += " --allow-outside";
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
