// Maps from the unit square to the shapes that get sampled; each with its density.

/// Uniform on the unit disk, polar map: area 1/pi density.
FN vec2 disk_uniform(vec2 u) {
    Real r = sqrtR(u.x);
    SinCos phi = sincos_turns(u.y);
    return v2(r * phi.cosine, r * phi.sine);
}

/// Cosine-weighted direction about +z; pdf = z / pi (solid angle). z > 0 always, since u.x < 1.
FN vec3 hemisphere_cosine(vec2 u) {
    vec2 p = disk_uniform(u);
    return v3(p.x, p.y, sqrtR(R(1.) - u.x));
}

/// Uniform direction; pdf = 1 / (4 pi).
FN vec3 sphere_uniform(vec2 u) {
    Real z = R(1.) - 2.f * u.x;
    Real r = 2.f * sqrtR(u.x * (R(1.) - u.x));
    SinCos phi = sincos_turns(u.y);
    return v3(r * phi.cosine, r * phi.sine, z);
}

/// Barycentrics (of the second and third corner) of a uniform point on a triangle; pdf = 1 / area.
/// Low-distortion map of Heitz 2019, "A low-distortion map between triangle and square".
FN vec2 triangle_uniform(vec2 u) {
    Mask upper = u.y > u.x;
    Real half_min = .5f * sel(upper, u.x, u.y);
    return v2(sel(upper, half_min, u.x - half_min), sel(upper, u.y - half_min, half_min));
}
