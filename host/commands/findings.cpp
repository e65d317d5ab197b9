// What follows from what `parhelion doctor` has found: what is wrong, and what to do.
#include "host/commands/diagnosis.h"

#include "host/cl/driver_watch.h"

#include <fmt/format.h>

namespace parhelion {
namespace {

/// With less, kernels of a large scene cannot be compiled (tests/environment: memory).
constexpr std::uint64_t little_memory = std::uint64_t{1} << 30;

using Findings = std::vector<Finding>;

void find_devices(const Examination& e, Findings& found) {
    for (const std::string& failure : e.failures)
        if (!e.devices.empty())
            found.push_back({false, failure, "nothing, if another device is to be used"});
    if (!e.no_device.empty())
        found.push_back({true, e.no_device,
                         "install an OpenCL driver, or name it by "
                         "OCL_ICD_VENDORS"});
    for (const TestedDevice& device : e.devices) {
        const Device& d = device.device;
        const bool chosen = e.chosen == d.index;
        if (!device.failure.empty())
            found.push_back({chosen,
                             fmt::format("device {} ({}) fails its self-test: {}", d.index, d.name,
                                         device.failure),
                             chosen ? "update its driver, or render with another --device"
                                    : "do not render with it"});
        if (chosen && d.rounding_option.empty())
            found.push_back({false,
                             fmt::format("device {} does not round division and square root "
                                         "correctly",
                                         d.index),
                             "expect other bits than on other devices, within rounding"});
    }
}

void find_folders(const Examination& e, Findings& found) {
    if (!e.bad_cache_size.empty())
        found.push_back({true, e.bad_cache_size, "set it right, or not at all"});
    if (e.cache.name.empty())
        found.push_back({false,
                         "there is no folder for compiled kernels: they are compiled again "
                         "each time",
                         "set PARHELION_CACHE_DIR"});
    else if (!e.cache.why_not.empty())
        found.push_back({false,
                         fmt::format("the cache folder {} cannot be written ({}): new kernels are "
                                     "compiled again each time",
                                     e.cache.name, e.cache.why_not),
                         "set PARHELION_CACHE_DIR to one that can"});
    if (!e.temporary.why_not.empty())
        found.push_back({e.temporary.name.empty(), e.temporary.why_not,
                         "set TMPDIR to a folder with room for programs"});
    if (!e.current.why_not.empty())
        found.push_back({false,
                         fmt::format("the current folder {} cannot be written ({})", e.current.name,
                                     e.current.why_not),
                         "give --output a name in another folder"});
}

void find_limits(const Examination& e, Findings& found) {
    const Machine& m = e.machine;
    if (m.usable_processors > 0 && m.usable_processors < m.processors)
        found.push_back({false,
                         fmt::format("this process may run on {} of {} processors",
                                     m.usable_processors, m.processors),
                         "give --threads, or start it without taskset"});
    if (m.cgroup.processors && *m.cgroup.processors < m.usable_processors)
        found.push_back({false,
                         fmt::format("the control group allows {:.3g} of {} processors",
                                     *m.cgroup.processors, m.usable_processors),
                         "give --threads that number, or ask for more"});
    if (m.cgroup.memory_bytes && *m.cgroup.memory_bytes < m.memory_bytes)
        found.push_back({false,
                         fmt::format("the control group allows {} of {} MB of memory",
                                     *m.cgroup.memory_bytes >> 20, m.memory_bytes >> 20),
                         "ask for more where a render is killed"});
    if (m.address_space_bytes)
        found.push_back(
            {false, fmt::format("ulimit -v allows {} MB of memory", *m.address_space_bytes >> 20),
             "ulimit -v unlimited, where kernels cannot be compiled"});
    if (m.free_memory_bytes > 0 && m.free_memory_bytes < little_memory)
        found.push_back({false, fmt::format("{} MB of memory are free", m.free_memory_bytes >> 20),
                         "end other programs where a render runs out of memory"});
}

} // namespace

Findings findings(const Examination& examination) {
    Findings found;
    find_devices(examination, found);
    find_folders(examination, found);
    find_limits(examination, found);
    return found;
}

} // namespace parhelion
