// Leaving a surface without hitting it again, at any scale of the scene.

/// gamma(n) of Higham 2002: n half-ulps, compounded. Bounds the relative error of n roundings.
#define HALF_ULP 5.9604644775390625e-8f
#define GAMMA(n) ((Real)((n)*HALF_ULP / (1.f - (n)*HALF_ULP)))

/// A point of the surface moved off it to the side that w points to, by no more than the rounding
/// error of the point itself (error: absolute bounds a coordinate), then on to the next float
/// (Pharr, Jakob and Humphreys 2016, section 3.9.5).
FN vec3 leave_surface(vec3 p, vec3 error, vec3 n, vec3 w) {
    Real distance = dot3(abs3(n), error);
    vec3 offset = scale3(n, copysignR(distance, dot3(w, n)));
    vec3 q = add3(p, offset);
    return v3(sel(offset.x > R(0.), nextUp(q.x), sel(offset.x < R(0.), nextDown(q.x), q.x)),
              sel(offset.y > R(0.), nextUp(q.y), sel(offset.y < R(0.), nextDown(q.y), q.y)),
              sel(offset.z > R(0.), nextUp(q.z), sel(offset.z < R(0.), nextDown(q.z), q.z)));
}
