// Versions of the format, and what files older than 2.0 write otherwise.
#pragma once

#include "host/scene/mitsuba/document.h"

#include <array>
#include <string>
#include <string_view>
#include <vector>

namespace parhelion::mitsuba {

/// Numbers "1.2" or "1.2.3", as in the version attribute; a version newer than the one that is read
/// is noted. Throws InputError at `place`.
std::array<int, 3> parse_version(std::string_view text, const SourceLocation& place,
                                 std::vector<std::string>& notes);

/// fovAxis -> fov_axis: such files name their parameters so.
std::string snake_case(std::string_view name);

/// What Mitsuba 3 makes of a plugin of such a file, whose parameters are in snake_case already: the
/// names of what it holds are too, `diffuse_reflectance` of diffuse is `reflectance`, and uoffset,
/// voffset, uscale, vscale become `to_uv`, which shifts first and scales then.
void upgrade_old_object(Object& object);

} // namespace parhelion::mitsuba
