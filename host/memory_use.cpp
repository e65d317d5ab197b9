// Memory of this process.
#include "host/memory_use.h"

#include <fstream>
#include <sstream>
#include <string>

#include <malloc.h>

namespace parhelion {
namespace {

/// Of a line "KEY: NUMBER kB" that the system says of this process. (getrusage tells of what was
/// in the process before the program, too.)
std::uint64_t status_bytes(const std::string& key) {
    std::ifstream in("/proc/self/status");
    for (std::string line; std::getline(in, line);) {
        if (!line.starts_with(key + ":")) continue;
        std::istringstream number(line.substr(key.size() + 1));
        std::uint64_t kilobytes = 0;
        number >> kilobytes;
        return kilobytes * 1024;
    }
    return 0;
}

} // namespace

std::uint64_t peak_host_bytes() { return status_bytes("VmHWM"); }

std::uint64_t resident_host_bytes() {
    malloc_trim(0);
    return status_bytes("VmRSS");
}

} // namespace parhelion
