// Memory of this process, and what the system says of memory.
#include "host/memory_use.h"

#include <fstream>
#include <sstream>
#include <string>

#include <malloc.h>

namespace parhelion {
std::uint64_t kilobyte_line(const char* file, const std::string& key) {
    std::ifstream in(file);
    for (std::string line; std::getline(in, line);) {
        if (!line.starts_with(key + ":")) continue;
        std::istringstream number(line.substr(key.size() + 1));
        std::uint64_t kilobytes = 0;
        number >> kilobytes;
        return kilobytes * 1024;
    }
    return 0;
}

namespace {

// getrusage tells of what was in the process before the program, too.
constexpr const char* own_status = "/proc/self/status";

} // namespace

std::uint64_t peak_host_bytes() { return kilobyte_line(own_status, "VmHWM"); }

std::uint64_t resident_host_bytes() {
    malloc_trim(0);
    return kilobyte_line(own_status, "VmRSS");
}

} // namespace parhelion
