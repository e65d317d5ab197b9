// Amounts of memory on the command line.
#pragma once

#include <cstdint>
#include <string>

namespace parhelion {

/// Bytes of "512M", "2G" or "1.5G": K, M, G, T stand for powers of 1024, as in Slurm; without one
/// the number is of bytes. Throws InputError, naming the option, for another text and for 0.
std::uint64_t parse_byte_size(const std::string& option, const std::string& text);

} // namespace parhelion
