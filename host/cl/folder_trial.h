// Can a folder be written to?
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

namespace parhelion {

/// Why `folder` takes no further `bytes`: one line, or nothing where it does. It is made where it
/// is not there; the file that tries it has no name and leaves nothing behind.
std::string why_not_writable(const std::filesystem::path& folder, std::uint64_t bytes);

/// Whether programs may be loaded from there: a file system mounted `noexec` refuses them.
bool may_hold_programs(const std::filesystem::path& folder);

} // namespace parhelion
