// What tests of traces compare with.
#pragma once

#include <glm/geometric.hpp>

#include <cmath>

namespace parhelion::test {

inline bool near(const glm::dvec3& a, const glm::dvec3& b, double relative, double absolute = 0) {
    return glm::length(a - b) <= relative * glm::length(b) + absolute;
}

/// Veach 1997, section 9.2.4; an infinite density is the only strategy there is.
inline double power_heuristic(double own, double other) {
    return std::isinf(own) ? 1 : own * own / (own * own + other * other);
}

} // namespace parhelion::test
