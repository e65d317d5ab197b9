// The elements inside <transform>, each as a 4x4 matrix.
#pragma once

#include "host/error.h"

#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>

#include <string>
#include <string_view>

namespace parhelion::mitsuba {

/// Along `v` and of unit length, however long or short it is; NaN for zero.
glm::dvec3 unit_vector(const glm::dvec3& v);

/// Turns about `axis` (any length but zero) through the origin, counter-clockwise by `degrees`.
glm::dmat4 rotation(const glm::dvec3& axis, double degrees);

/// Camera frame: z from `origin` to `target`, y near `up`, x = up cross z (to the left of the
/// image). An `up` of zero picks some perpendicular direction. Throws InputError at `place` where
/// the frame is undefined.
glm::dmat4 look_at(const glm::dvec3& origin, const glm::dvec3& target, const glm::dvec3& up,
                   const SourceLocation& place);

/// 9 or 16 numbers, row by row. Throws InputError, also for a last row other than 0 0 0 1.
glm::dmat4 parse_matrix(std::string_view text, const SourceLocation& place);

/// Three numbers. Throws InputError at `place`.
glm::dvec3 parse_vector(std::string_view text, const char* what, const SourceLocation& place);

} // namespace parhelion::mitsuba
