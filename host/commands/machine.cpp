// What the machine is and what of it this process may use.
#include "host/commands/machine.h"

#include "host/memory_use.h"

#include <fmt/format.h>

#include <fstream>

#include <sched.h>
#include <sys/resource.h>
#include <sys/utsname.h>
#include <unistd.h>

namespace parhelion {
namespace {

/// What stands behind `key` and `separator` in the first line of `file` that begins so.
std::string value_in(const char* file, const std::string& key, char separator) {
    std::ifstream in(file);
    for (std::string line; std::getline(in, line);) {
        if (!line.starts_with(key)) continue;
        const std::size_t at = line.find(separator);
        const std::size_t first =
            at == std::string::npos ? at : line.find_first_not_of(" \t\"", at + 1);
        if (first == std::string::npos) return "";
        return line.substr(first, line.find_last_not_of(" \t\"") + 1 - first);
    }
    return "";
}

std::string kernel_text() {
    utsname names{};
    if (uname(&names) != 0) return "";
    return fmt::format("{} {} {}", names.sysname, names.release, names.machine);
}

int usable_processors() {
    cpu_set_t set;
    CPU_ZERO(&set);
    if (sched_getaffinity(0, sizeof set, &set) != 0) return 0; // more than the set has room for
    return CPU_COUNT(&set);
}

std::uint64_t meminfo_bytes(const std::string& key) { return kilobyte_line("/proc/meminfo", key); }

std::optional<std::uint64_t> address_space() {
    rlimit limit{};
    if (getrlimit(RLIMIT_AS, &limit) != 0 || limit.rlim_cur == RLIM_INFINITY) return std::nullopt;
    return limit.rlim_cur;
}

} // namespace

Machine this_machine() {
    return {.system = value_in("/etc/os-release", "PRETTY_NAME=", '='),
            .kernel = kernel_text(),
            .processor = value_in("/proc/cpuinfo", "model name", ':'),
            .processors = static_cast<int>(sysconf(_SC_NPROCESSORS_ONLN)),
            .usable_processors = usable_processors(),
            .memory_bytes = meminfo_bytes("MemTotal"),
            .free_memory_bytes = meminfo_bytes("MemAvailable"),
            .address_space_bytes = address_space(),
            .cgroup = cgroup_limits()};
}

} // namespace parhelion
