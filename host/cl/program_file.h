// One file of the cache of compiled programs: its key, the binary, and a checksum.
#pragma once

#include "host/cl/program_cache.h"

namespace parhelion {

/// 16 hexadecimal digits of the hash of a key, and the ending that names such files.
std::string program_file_name(const std::string& key);
/// Whether a file of that name belongs to a cache: programs, damaged ones, unfinished ones.
bool is_program_file(const std::string& name);

/// What `file` holds for `key`. A file that does not hold what it says, or is no file, is renamed
/// to <name>.damaged where that can be.
CachedProgram read_program_file(const std::filesystem::path& file, const std::string& key);

/// Puts a file there whole or not at all. Returns nothing, or why it cannot be written.
std::string write_program_file(const std::filesystem::path& file, const std::string& key,
                               const std::vector<unsigned char>& binary);

} // namespace parhelion
