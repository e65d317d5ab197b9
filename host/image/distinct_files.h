// Files that a command must not mistake for each other.
#pragma once

#include <string>
#include <vector>

namespace parhelion {

/// A file that a command reads or writes.
struct UsedFile {
    std::string role; ///< "--stats", "the scene"
    std::string name; ///< empty: not used
};

/// Throws InputError where an output is another output or an input: the same file by any spelling,
/// by symbolic or hard links, or, where it does not exist yet, the same name in the same folder.
void check_distinct(const std::vector<UsedFile>& outputs, const std::vector<UsedFile>& inputs);

} // namespace parhelion
