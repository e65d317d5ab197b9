// Names of files that are made of what a render is: out-$frame.exr.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace parhelion {

/// What a name may be made of.
struct NameValues {
    std::vector<std::pair<std::string, std::string>>
        values;                        ///< of $name; the first of a name counts
    std::optional<std::int64_t> frame; ///< of --frames, for #### and %04d
};

/// `pattern` with $name (the longest that there is, as in scene files) replaced by its value, and,
/// where there is a frame, #### by its digits, as many at least (Blender's), and %04d as printf
/// has it (Maya's, Nuke's). A backslash before one of $ # % takes it for itself. Throws InputError,
/// naming `option`, for a $name that there is not.
std::string expanded_name(const std::string& option, const std::string& pattern,
                          const NameValues& values);

} // namespace parhelion
