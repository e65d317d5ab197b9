// Leaving a surface without hitting it again, at any scale of the scene.

/// gamma(n) of Higham 2002: n half-ulps, compounded. Bounds the relative error of n roundings.
#define GAMMA(n) ((Real)((n)*HALF_ULP / (1.f - (n)*HALF_ULP)))

/// Where a shadow ray to a point of a light ends, of its length: short of it by the rounding error
/// of a hit distance.
FN Real shadow_ray_end(void) { return R(1.) - GAMMA(32.f); }

/// How far a ray must stand off a surface of the normal n for the rounding error of its origin
/// (absolute bounds a coordinate; Pharr, Jakob and Humphreys 2016, section 3.9.5).
FN vec3 surface_clearance(vec3 error, vec3 n) { return scale3(n, dot3(abs3(n), error)); }

/// A point of the surface moved off it to the side that w points to, by its clearance, then on to
/// the next float.
FN vec3 leave_surface(vec3 p, vec3 clearance, vec3 n, vec3 w) {
    vec3 offset = scale3(clearance, copysignR(R(1.), dot3(w, n)));
    vec3 q = add3(p, offset);
    return v3(nextAlong(q.x, offset.x), nextAlong(q.y, offset.y), nextAlong(q.z, offset.z));
}
