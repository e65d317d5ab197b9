// From a hit to the surface there: position with its error bound, geometric and shading normal,
// texture coordinates.

typedef struct {
    vec3 p;
    vec3 error;     // absolute rounding error bound of p, per coordinate
    vec3 ng;        // unit geometric normal
    vec3 ns;        // unit shading normal
    vec3 tangent;   // derivative of p along u, only where HAS(tangents); of some length
    vec3 tangent_v; // that along v, only where HAS(bump_maps); then either has its true length
    vec2 uv;
} SurfaceInteraction;

FN vec3 primitive_a(Primitive p) { return v3(p.ax, p.ay, p.az); }
FN vec3 primitive_b(Primitive p) { return v3(p.bx, p.by, p.bz); }
FN vec3 primitive_c(Primitive p) { return v3(p.cx, p.cy, p.cz); }
FN Int primitive_kind(Primitive p) { return p.flags & PRIMITIVE_KIND_MASK; }
FN Real primitive_side(Primitive p) {
    return sel((p.flags & PRIMITIVE_FLIPPED) != 0, R(-1.), R(1.));
}

/// Interpolates a, b, c by barycentrics (1 - b1 - b2, b1, b2).
FN vec3 interpolate3(vec3 a, vec3 b, vec3 c, Real b1, Real b2) {
    Real b0 = R(1.) - b1 - b2;
    return add3(add3(scale3(a, b0), scale3(b, b1)), scale3(c, b2));
}

FN SurfaceInteraction surface_triangle(Primitive p, Real b1, Real b2) {
    vec3 a = primitive_a(p), b = primitive_b(p), c = primitive_c(p);
    Real b0 = R(1.) - b1 - b2;
    SurfaceInteraction s;
    s.p = interpolate3(a, b, c, b1, b2);
    s.error = scale3(interpolate3(abs3(a), abs3(b), abs3(c), absR(b1), absR(b2)), GAMMA(7.f));
    // 1 - b1 - b2 can round to a small negative number; its share of the bound must not be.
    s.error = add3(s.error, scale3(abs3(a), (absR(b0) - b0) * GAMMA(7.f)));
    s.ng = scale3(cross3(sub3(b, a), sub3(c, a)), p.extra);
    s.ns = s.ng;
    s.uv = v2(b1, b2);
    s.tangent = splat3(R(0.));
    s.tangent_v = splat3(R(0.));
    // As in Mitsuba 3, where there are no texture coordinates.
    if (HAS(tangents)) s.tangent = sub3(b, a);
    if (HAS(bump_maps)) s.tangent_v = sub3(c, a);
    return s;
}

/// Shading normals interpolated by barycentrics from the normals of the corners.
FN vec3 interpolated_normal(Vertex v, Real b1, Real b2) {
    return interpolate3(v3(v.n0x, v.n0y, v.n0z), v3(v.n1x, v.n1y, v.n1z), v3(v.n2x, v.n2y, v.n2z),
                        b1, b2);
}

/// Replaces shading normal, texture coordinates and tangent of a triangle by those of its corners,
/// where they have them.
FN SurfaceInteraction surface_vertex_attributes(SurfaceInteraction s, Primitive p, Vertex v,
                                                Real b1, Real b2) {
    if (HAS(vertex_normals)) {
        vec3 n = interpolated_normal(v, b1, b2);
        Real length_squared = dot3(n, n);
        Mask usable = ((p.flags & PRIMITIVE_NORMALS) != 0) & (length_squared > R(0.));
        s.ns = sel3(usable, scale3(n, R(1.) / sqrtR(sel(usable, length_squared, R(1.)))), s.ns);
    }
    if (HAS(vertex_uvs)) {
        Mask usable = (p.flags & PRIMITIVE_UVS) != 0;
        Real b0 = R(1.) - b1 - b2;
        vec2 uv = v2(v.u0 * b0 + v.u1 * b1 + v.u2 * b2, v.v0 * b0 + v.v1 * b1 + v.v2 * b2);
        s.uv.x = sel(usable, uv.x, s.uv.x);
        s.uv.y = sel(usable, uv.y, s.uv.y);
        if (HAS(tangents)) {
            Real du1 = v.u1 - v.u0, dv1 = v.v1 - v.v0, du2 = v.u2 - v.u0, dv2 = v.v2 - v.v0;
            Real determinant = difference_of_products(du1, dv2, dv1, du2);
            vec3 e1 = sub3(primitive_b(p), primitive_a(p)),
                 e2 = sub3(primitive_c(p), primitive_a(p));
            vec3 along_u = sub3(scale3(e1, dv2), scale3(e2, dv1));
            Mask regular = usable & (determinant != R(0.));
            Real scale = copysignR(R(1.), determinant);
            if (HAS(bump_maps)) {
                scale = R(1.) / sel(regular, determinant, R(1.));
                vec3 along_v = sub3(scale3(e2, du1), scale3(e1, du2));
                s.tangent_v = sel3(regular, scale3(along_v, scale), s.tangent_v);
            }
            s.tangent = sel3(regular, scale3(along_u, scale), s.tangent);
        }
    }
    return s;
}

FN SurfaceInteraction surface_sphere(Primitive p, vec3 on_ray) {
    vec3 centre = primitive_a(p), axis_x = primitive_b(p), axis_z = primitive_c(p);
    vec3 outward = normalize3(sub3(on_ray, centre));
    SurfaceInteraction s;
    s.p = add3(
        centre,
        scale3(outward,
               p.extra)); // back on the sphere: the error no longer grows with the ray's length
    s.error = scale3(add3(abs3(centre), scale3(abs3(outward), p.extra)), GAMMA(7.f));
    s.ng = scale3(outward, primitive_side(p));
    s.ns = s.ng;
    s.tangent = splat3(R(0.));
    s.uv = v2(R(0.), R(0.));
    vec3 axis_y = cross3(axis_z, axis_x);
    vec3 in_axes = v3(dot3(outward, axis_x), dot3(outward, axis_y), dot3(outward, axis_z));
    if (HAS(analytic_uvs)) {
        Real phi = atan2R(in_axes.y, in_axes.x) * R(INV_TWO_PI);
        s.uv = v2(sel(phi < R(0.), phi + 1.f, phi),
                  acosR(maxR(R(-1.), minR(R(1.), in_axes.z))) * R(INV_PI));
    }
    if (HAS(tangents)) s.tangent = sub3(scale3(axis_y, in_axes.x), scale3(axis_x, in_axes.y));
    s.tangent_v = splat3(R(0.));
    if (HAS(bump_maps)) {
        s.tangent = scale3(s.tangent, R(TWO_PI) * p.extra);
        Real across = sqrtR(in_axes.x * in_axes.x + in_axes.y * in_axes.y);
        Mask leans = across > R(0.);
        Real share = in_axes.z / sel(leans, across, R(1.));
        vec3 down = sub3(add3(scale3(axis_x, in_axes.x * share), scale3(axis_y, in_axes.y * share)),
                         scale3(axis_z, across));
        s.tangent_v = sel3(leans, scale3(down, R(PI) * p.extra), s.tangent_v);
    }
    return s;
}

FN SurfaceInteraction surface_cylinder(Primitive p, vec3 on_ray) {
    vec3 base = primitive_a(p), axis = primitive_b(p), side = primitive_c(p);
    Real radius = absR(p.extra);
    vec3 to = sub3(on_ray, base), unit = normalize3(axis);
    Real along = dot3(to, axis) / dot3(axis, axis);
    // What lies across the axis, made of products: no difference of what lies along it. Then back
    // on the surface, as with spheres.
    vec3 outward = normalize3(cross3(unit, cross3(to, unit)));
    SurfaceInteraction s;
    s.p = add3(base, add3(scale3(axis, along), scale3(outward, radius)));
    s.error = scale3(
        add3(abs3(base), add3(scale3(abs3(axis), absR(along)), scale3(abs3(outward), radius))),
        GAMMA(7.f));
    s.ng = scale3(outward, primitive_side(p));
    s.ns = s.ng;
    s.tangent = splat3(R(0.));
    s.uv = v2(R(0.), R(0.));
    Real sign = copysignR(R(1.), p.extra);
    if (HAS(analytic_uvs)) {
        Real y = dot3(outward, cross3(unit, side)) * sign;
        Real phi = atan2R(y, dot3(outward, side)) * R(INV_TWO_PI);
        s.uv = v2(sel(phi < R(0.), phi + 1.f, phi), along);
    }
    if (HAS(tangents)) s.tangent = scale3(cross3(unit, outward), sign);
    s.tangent_v = splat3(R(0.));
    if (HAS(bump_maps)) {
        s.tangent = scale3(s.tangent, R(TWO_PI) * radius);
        s.tangent_v = axis;
    }
    return s;
}

/// b1, b2: coordinates of the hit along the two edges.
FN SurfaceInteraction surface_disk(Primitive p, Real b1, Real b2) {
    vec3 centre = primitive_a(p), edge_u = primitive_b(p), edge_v = primitive_c(p);
    SurfaceInteraction s;
    s.p = add3(centre, add3(scale3(edge_u, b1), scale3(edge_v, b2)));
    s.error = scale3(
        add3(abs3(centre), add3(scale3(abs3(edge_u), absR(b1)), scale3(abs3(edge_v), absR(b2)))),
        GAMMA(7.f));
    s.ng = scale3(cross3(edge_u, edge_v), p.extra * primitive_side(p));
    s.ns = s.ng;
    s.tangent = splat3(R(0.));
    s.uv = v2(R(0.), R(0.));
    Real r = sqrtR(b1 * b1 + b2 * b2);
    if (HAS(analytic_uvs)) {
        Real phi = atan2R(b2, b1) * R(INV_TWO_PI);
        s.uv = v2(r, sel(phi < R(0.), phi + 1.f, phi));
    }
    if (HAS(tangents)) {
        Mask centred = r == R(0.);
        s.tangent = sel3(centred, edge_u, add3(scale3(edge_u, b1), scale3(edge_v, b2)));
        if (HAS(bump_maps)) s.tangent = scale3(s.tangent, R(1.) / sel(centred, R(1.), r));
    }
    s.tangent_v = splat3(R(0.));
    if (HAS(bump_maps))
        s.tangent_v = scale3(sub3(scale3(edge_v, b1), scale3(edge_u, b2)), R(TWO_PI));
    return s;
}

FN SurfaceInteraction sel_surface(Mask m, SurfaceInteraction a, SurfaceInteraction b) {
    SurfaceInteraction s;
    s.p = sel3(m, a.p, b.p);
    s.error = sel3(m, a.error, b.error);
    s.ng = sel3(m, a.ng, b.ng);
    s.ns = sel3(m, a.ns, b.ns);
    s.tangent = sel3(m, a.tangent, b.tangent);
    s.tangent_v = sel3(m, a.tangent_v, b.tangent_v);
    s.uv = v2(sel(m, a.uv.x, b.uv.x), sel(m, a.uv.y, b.uv.y));
    return s;
}

/// The frame BSDFs are evaluated in.
FN ShadingFrame surface_frame(SurfaceInteraction s) {
    if (HAS(tangents)) return frame_from_tangent(s.ns, s.tangent);
    return frame_from_normal(s.ns);
}
