// A ray and the plane of a triangle in double precision, of the corners and rays that kernels get
// in single.
#pragma once

#include "host/numerics/ray_states.h"
#include "host/shared_maths.h"
#include "kernels/shared/types.h"

#include <algorithm>
#include <cmath>

namespace parhelion::numerics {

/// Where the ray meets the plane: `t` along it, the smallest barycentric there; and the lengths
/// that say how far a rounding error moves it: of the normal (twice the area) and of the ray's way
/// to corner a, whose share along the normal is `height`, a length times that of the normal.
struct PlaneMeeting {
    double t, inside;
    double normal, to_corner, height;
};

inline PlaneMeeting plane_meeting(const PrimitiveRecord& p, const TracedRay& r) {
    using f64::cross3, f64::dot3, f64::sub3;
    f64::vec3 a{p.ax, p.ay, p.az}, b{p.bx, p.by, p.bz}, c{p.cx, p.cy, p.cz};
    f64::vec3 o{r.origin[0], r.origin[1], r.origin[2]},
        d{r.direction[0], r.direction[1], r.direction[2]};
    f64::vec3 e1 = sub3(b, a), e2 = sub3(c, a), n = cross3(e1, e2), to = sub3(a, o);
    double facing = dot3(d, n), height = dot3(to, n);
    f64::vec3 q = cross3(to, d);
    double v = dot3(e2, q) / facing, w = -dot3(e1, q) / facing;
    return {height / facing, std::min({1 - v - w, v, w}), std::sqrt(dot3(n, n)),
            std::sqrt(dot3(to, to)), height};
}

} // namespace parhelion::numerics
