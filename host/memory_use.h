// Memory of this process, and what the system says of memory.
#pragma once

#include <cstdint>
#include <string>

namespace parhelion {

/// Of a line "KEY: NUMBER kB" in a file of the system, bytes; 0 where there is none.
std::uint64_t kilobyte_line(const char* file, const std::string& key);

/// The most there has been, bytes.
std::uint64_t peak_host_bytes();

/// What there is now, bytes, after what is free has been given back to the system.
std::uint64_t resident_host_bytes();

} // namespace parhelion
