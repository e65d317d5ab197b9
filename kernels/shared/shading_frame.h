// The tangent frame in which BSDFs live: s, t and the shading normal n as x, y and z.

typedef struct {
    vec3 s, t, n;
} ShadingFrame;

/// Orthonormal frame about a unit normal (Duff et al. 2017, "Building an orthonormal basis,
/// revisited").
FN ShadingFrame frame_from_normal(vec3 n) {
    Real sign = copysignR(R(1.), n.z);
    Real a = R(-1.) / (sign + n.z);
    Real b = n.x * n.y * a;
    ShadingFrame f;
    f.s = v3(R(1.) + sign * n.x * n.x * a, sign * b, -sign * n.x);
    f.t = v3(b, sign + n.y * n.y * a, -n.y);
    f.n = n;
    return f;
}

/// Frame about n whose s follows the tangent (surface derivative along u), for anisotropic
/// surfaces.
FN ShadingFrame frame_from_tangent(vec3 n, vec3 tangent) {
    vec3 in_plane = sub3(tangent, scale3(n, dot3(n, tangent)));
    Real squared = dot3(in_plane, in_plane);
    ShadingFrame plain = frame_from_normal(n);
    Mask usable = squared > R(0.);
    ShadingFrame f;
    f.s = sel3(usable, scale3(in_plane, R(1.) / sqrtR(sel(usable, squared, R(1.)))), plain.s);
    f.t = cross3(n, f.s);
    f.n = n;
    return f;
}

FN vec3 to_local(ShadingFrame f, vec3 v) { return v3(dot3(v, f.s), dot3(v, f.t), dot3(v, f.n)); }
FN vec3 to_world(ShadingFrame f, vec3 v) {
    return add3(add3(scale3(f.s, v.x), scale3(f.t, v.y)), scale3(f.n, v.z));
}

/// Mirror direction about the normal (0, 0, 1).
FN vec3 reflect_local(vec3 w) { return v3(-w.x, -w.y, w.z); }

/// Mirror direction of w about a unit normal h.
FN vec3 reflect_about(vec3 w, vec3 h) { return sub3(scale3(h, 2.f * dot3(w, h)), w); }
