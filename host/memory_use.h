// Memory of this process.
#pragma once

#include <cstdint>

namespace parhelion {

/// The most there has been, bytes.
std::uint64_t peak_host_bytes();

/// What there is now, bytes, after what is free has been given back to the system.
std::uint64_t resident_host_bytes();

} // namespace parhelion
