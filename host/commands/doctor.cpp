// `parhelion doctor`: everything about this machine that a bug report should say.
#include "host/commands/doctor.h"

#include "host/cl/folder_trial.h"
#include "host/cl/no_device.h"
#include "host/cl/program_cache.h"
#include "host/cl/work_folder.h"
#include "host/commands/diagnosis.h"
#include "host/error.h"
#include "host/json_text.h"
#include "host/streams.h"

#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <memory>

namespace parhelion {
namespace {

namespace fs = std::filesystem;

constexpr std::uint64_t trial_bytes = 4u << 20; ///< a program of kernels

/// Those that have a say in a render, and no others: others may hold secrets.
bool has_a_say(std::string_view name) {
    constexpr std::array<std::string_view, 4> names{"OCL_ICD_VENDORS", "OPENCL_VENDOR_PATH",
                                                    "XDG_CACHE_HOME", "TMPDIR"};
    return name.starts_with("PARHELION_") || name.starts_with("POCL_") ||
           std::find(names.begin(), names.end(), name) != names.end();
}

std::vector<std::pair<std::string, std::string>> variables() {
    std::vector<std::pair<std::string, std::string>> found;
    for (char** entry = environ; *entry; entry++) {
        const std::string_view text = *entry;
        const std::size_t equals = std::min(text.find('='), text.size());
        if (has_a_say(text.substr(0, equals)))
            found.emplace_back(text.substr(0, equals),
                               text.substr(std::min(equals + 1, text.size())));
    }
    std::sort(found.begin(), found.end());
    return found;
}

void examine_cache(Examination& e) {
    try {
        const ProgramCache cache = ProgramCache::standard();
        e.cache.name = cache.folder().string();
        if (!cache.folder().empty())
            e.cache.why_not = why_not_writable(cache.folder(), trial_bytes);
        const ProgramCache::Use use = cache.use();
        e.cached_programs = use.programs;
        e.cache_bytes = use.bytes;
        e.most_cache_bytes = use.most_bytes;
    } catch (const InputError& error) {
        e.bad_cache_size = error.what();
    }
}

/// Before the first call of OpenCL, which needs it.
void examine_temporary(Examination& e) {
    try {
        e.temporary.name = work_folder({e.cache.name}).parent_path().string();
        const char* wanted = std::getenv("TMPDIR");
        std::error_code ignored;
        if (wanted && *wanted && !fs::equivalent(wanted, e.temporary.name, ignored))
            e.temporary.why_not = std::string("TMPDIR, ") + wanted + ", cannot be used";
    } catch (const DeviceError& error) {
        e.temporary.why_not = error.what();
    }
}

void examine_current(Examination& e) {
    std::error_code error;
    e.current.name = fs::current_path(error).string();
    e.current.why_not = error ? error.message() : why_not_writable(e.current.name, trial_bytes);
}

void examine_devices(Examination& e) {
    try {
        const DeviceList list = list_devices();
        e.failures = list.failures;
        e.devices.reserve(list.devices.size());
        for (const Device& device : list.devices)
            e.devices.push_back(tested(device));
        if (list.devices.empty())
            e.no_device = why_no_device(list);
        else
            e.chosen = choose_device("").index;
    } catch (const DeviceError& error) {
        e.no_device = error.what();
    }
}

int run_doctor(bool json) {
    Examination e{.machine = this_machine(), .variables = variables()};
    examine_cache(e);
    examine_current(e);
    examine_temporary(e);
    if (!e.temporary.name.empty() && e.bad_cache_size.empty()) examine_devices(e);
    print(json ? json_text(to_json(e)) : text_of(e));
    const std::vector<Finding> found = findings(e);
    const bool prevented = std::any_of(found.begin(), found.end(),
                                       [](const Finding& finding) { return finding.prevents; });
    return static_cast<int>(prevented ? ExitCode::device_failure : ExitCode::ok);
}

} // namespace

Subcommand doctor_subcommand() {
    auto json = std::make_shared<bool>(false);
    return {
        .name = "doctor",
        .summary = "Say what this machine has for a render and what is wrong with it: a page for a "
                   "bug report; exit code 3 if a render would not work",
        .examples = "Example:\n  parhelion doctor --json | jq '.findings[]'",
        .options = {{"--json", json.get(), "One JSON object"}},
        .run = [json] { return run_doctor(*json); },
    };
}

} // namespace parhelion
