// Files of a folder as one run of bytes, and back.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace parhelion {

/// `files`, paths below `root`, with their contents. Nothing where one cannot be read.
std::optional<std::vector<unsigned char>> pack_files(const std::filesystem::path& root,
                                                     const std::vector<std::string>& files);

/// Writes them below `root` again, for the user alone; those that are there stay as they are.
/// Returns their paths, or nothing where `bytes` are no packed files, name a place outside of
/// `root`, or cannot be written.
std::optional<std::vector<std::string>> unpack_files(const std::vector<unsigned char>& bytes,
                                                     const std::filesystem::path& root);

} // namespace parhelion
