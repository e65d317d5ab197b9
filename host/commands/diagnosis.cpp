// What `parhelion doctor` has found, as a page and as JSON.
#include "host/commands/diagnosis.h"

#include "host/commands/version.h"
#include "host/safe_text.h"
#include "parhelion_version.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace parhelion {
namespace {

using nlohmann::ordered_json;

std::string megabytes(std::uint64_t bytes) { return fmt::format("{} MB", bytes >> 20); }

std::string megabytes(const std::optional<std::uint64_t>& bytes) {
    return bytes ? megabytes(*bytes) : "no limit";
}

std::string folder_text(const TriedFolder& folder) {
    if (folder.name.empty()) return "none";
    return fmt::format("{} ({})", folder.name,
                       folder.why_not.empty() ? "can be written" : folder.why_not);
}

std::string machine_text(const Machine& m) {
    return fmt::format(
        "system       {}, {}\n"
        "processor    {}; {} on line, {} usable, control group: {}\n"
        "memory       {}, {} free; ulimit -v: {}, control group: {}\n",
        m.system.empty() ? "unknown" : m.system, m.kernel,
        m.processor.empty() ? "unknown" : m.processor, m.processors, m.usable_processors,
        m.cgroup.processors ? fmt::format("{:.3g}", *m.cgroup.processors) : "no limit",
        megabytes(m.memory_bytes), megabytes(m.free_memory_bytes), megabytes(m.address_space_bytes),
        megabytes(m.cgroup.memory_bytes));
}

std::string devices_text(const Examination& e) {
    std::string text = "devices\n";
    for (const TestedDevice& device : e.devices)
        text += text_of(device);
    for (const std::string& failure : e.failures)
        text += failure + "\n";
    if (e.devices.empty() && e.failures.empty()) text += "none\n";
    return text;
}

std::string findings_text(const std::vector<Finding>& found) {
    if (found.empty()) return "nothing is wrong\n";
    std::string text;
    for (const Finding& finding : found)
        text += fmt::format("{}: {}; to do: {}\n", finding.prevents ? "WRONG" : "worth knowing",
                            finding.what, finding.to_do);
    return text;
}

ordered_json to_json(const TriedFolder& folder) {
    return {
        {"folder", folder.name}, {"writable", folder.why_not.empty()}, {"why_not", folder.why_not}};
}

template<class T>
ordered_json or_null(const std::optional<T>& value) {
    return value ? ordered_json(*value) : ordered_json(nullptr);
}

ordered_json to_json(const Machine& m) {
    return {{"system", m.system},
            {"kernel", m.kernel},
            {"processor", m.processor},
            {"processors", m.processors},
            {"usable_processors", m.usable_processors},
            {"cgroup_processors", or_null(m.cgroup.processors)},
            {"memory_bytes", m.memory_bytes},
            {"free_memory_bytes", m.free_memory_bytes},
            {"ulimit_bytes", or_null(m.address_space_bytes)},
            {"cgroup_memory_bytes", or_null(m.cgroup.memory_bytes)}};
}

} // namespace

std::string text_of(const Examination& e) {
    std::string text = version_text() + "\n" + machine_text(e.machine) + devices_text(e);
    text += fmt::format("cache        {}; {} programs, {} of {}\n", folder_text(e.cache),
                        e.cached_programs, megabytes(e.cache_bytes), megabytes(e.most_cache_bytes));
    text += fmt::format("temporary    {}\ncurrent      {}\n", folder_text(e.temporary),
                        folder_text(e.current));
    text += "variables   ";
    if (e.variables.empty()) text += " none of those that have a say";
    for (const auto& [name, value] : e.variables)
        text += fmt::format(" {}={}", name, as_one_line(value));
    return text + "\n\n" + findings_text(findings(e));
}

ordered_json to_json(const Examination& e) {
    ordered_json devices = ordered_json::array(), found = ordered_json::array(),
                 variables = ordered_json::object();
    for (const TestedDevice& device : e.devices)
        devices.emplace_back(to_json(device));
    for (const auto& [name, value] : e.variables)
        variables[name] = value;
    for (const Finding& finding : findings(e))
        found.push_back(
            {{"prevents", finding.prevents}, {"what", finding.what}, {"to_do", finding.to_do}});
    return {{"version", version_number},
            {"commit", version_commit},
            {"machine", to_json(e.machine)},
            {"devices", devices},
            {"failures", e.failures},
            {"chosen_device", or_null(e.chosen)},
            {"cache", to_json(e.cache)},
            {"cached_programs", e.cached_programs},
            {"cache_bytes", e.cache_bytes},
            {"most_cache_bytes", e.most_cache_bytes},
            {"temporary", to_json(e.temporary)},
            {"current", to_json(e.current)},
            {"variables", variables},
            {"findings", found}};
}

} // namespace parhelion
