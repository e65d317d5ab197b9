// Probes of intersection, surfaces, leaving them, and the camera.

FN ProbeOut out_intersection(Intersection i) {
    ProbeOut o = out1(mask_word(i.hit));
    // Where nothing is hit the rest is of no account.
    return put3(o, 1, sel3(i.hit, v3(i.t, i.b1, i.b2), splat3(R(0.))));
}
FN Corners in_corners(ProbeIn i) {
    Corners v;
    v.a = in3(i, 0);
    v.b = in3(i, 3);
    v.c = in3(i, 6);
    return v;
}
FN RayShear in_ray(ProbeIn i) {
    RayShear ray;
    ray.origin = splat3(R(0.));
    ray.shear_x = i.w[9] * R(.01);
    ray.shear_y = i.w[10] * R(.01);
    ray.shear_z = i.w[11];
    ray.doubt = ray_doubt(ray.shear_z, R(4.));
    return ray;
}
FN ProbeOut probe_intersect_triangle(ProbeIn i) {
    return out_intersection(intersect_triangle(in_corners(i), in_ray(i), absR(i.w[12])));
}
FN ProbeOut probe_intersect_triangle_through_corners(ProbeIn i) {
    Corners v = in_corners(i);
    RayShear ray = in_ray(i); // through a corner, an edge or the inside of the triangle
    vec3 aim = add3(scale3(v.a, i.w[9]), scale3(v.b, R(1.) - i.w[9]));
    ray.shear_x = aim.x / aim.z;
    ray.shear_y = aim.y / aim.z;
    ray.shear_z = R(1.) / aim.z;
    return out_intersection(intersect_triangle(v, ray, LANE_INFINITY));
}
FN ProbeOut probe_triangle_blocks(ProbeIn i) {
    return out1(mask_word(triangle_occludes(in_corners(i), in_ray(i), absR(i.w[12]))));
}
/// A ray that starts on the triangle, but for rounding.
FN RayShear in_ray_from_triangle(ProbeIn i) {
    RayShear ray = in_ray(i);
    Corners v = in_corners(i);
    Real b1 = i.w[12], b2 = i.w[13] * (R(1.) - b1);
    ray.origin = add3(scale3(v.a, R(1.) - b1 - b2), add3(scale3(v.b, b1), scale3(v.c, b2)));
    return ray;
}
FN ProbeOut probe_triangle_started_on(ProbeIn i) {
    RayShear ray = in_ray_from_triangle(i);
    ProbeOut o = out_intersection(intersect_triangle(in_corners(i), ray, LANE_INFINITY));
    return put1(o, 4, mask_word(triangle_occludes(in_corners(i), ray, LANE_INFINITY)));
}
FN ProbeOut probe_plane_side(ProbeIn i) {
    PlaneSide p = plane_side(in_corners(i), in_ray_from_triangle(i), i.w[11]);
    return put1(out1(mask_word(p.ahead)), 1, p.t);
}
FN ProbeOut probe_intersect_sphere(ProbeIn i) {
    return out_intersection(intersect_sphere(in3(i, 0), in3(i, 3), i.w[6], LANE_INFINITY));
}
FN ProbeOut probe_intersect_cylinder(ProbeIn i) {
    return out_intersection(
        intersect_cylinder(in3(i, 0), in3(i, 3), in3(i, 6), i.w[9], i.w[10], LANE_INFINITY));
}
FN ProbeOut probe_intersect_disk(ProbeIn i) {
    return out_intersection(
        intersect_disk(in3(i, 0), in3(i, 3), in3(i, 6), in3(i, 9), LANE_INFINITY));
}
FN ProbeOut probe_box_overlap(ProbeIn i) {
    BoxOverlap b = box_overlap(i.w[0], i.w[1], i.w[2], i.w[3], i.w[4], i.w[5], i.w[6]);
    return put1(out1(mask_word(b.meets)), 1, b.entry);
}
FN ProbeOut probe_ray_slab(ProbeIn i) {
    TreeSizes nothing = {0, 0};
    RaySlab s = ray_slab(i.w[0], i.w[1], absR(i.w[2]), nothing);
    return put2(out1(s.inverse), 1, v2(s.near_offset, s.far_offset));
}
FN ProbeOut probe_leave_surface(ProbeIn i) {
    vec3 error = abs3(scale3(in3(i, 3), GAMMA(7.f))), n = in3(i, 6);
    return out3(leave_surface(in3(i, 0), surface_clearance(error, n), n, in3(i, 9)));
}
FN ProbeOut out_surface(SurfaceInteraction s) {
    ProbeOut o = put3(put3(put3(no_output(), 0, s.p), 3, s.error), 6, s.ng);
    o = put2(put3(put3(o, 9, s.ns), 12, s.tangent), 15, s.uv);
    ShadingFrame f = surface_frame(s);
    return put3(put3(o, 17, f.s), 20, f.t);
}
FN ProbeOut probe_surface_triangle(ProbeIn i) {
    vec2 b = triangle_uniform(in2(i, 11));
    return out_surface(surface_triangle(in_Primitive(i, 0), b.x, b.y));
}
FN ProbeOut probe_surface_vertex_attributes(ProbeIn i) {
    vec2 b = triangle_uniform(in2(i, 26));
    Primitive p = in_Primitive(i, 0);
    return out_surface(
        surface_vertex_attributes(surface_triangle(p, b.x, b.y), p, in_Vertex(i, 11), b.x, b.y));
}
FN ProbeOut probe_surface_sphere(ProbeIn i) {
    return out_surface(surface_sphere(in_Primitive(i, 0), in3(i, 11)));
}
FN ProbeOut probe_surface_cylinder(ProbeIn i) {
    return out_surface(surface_cylinder(in_Primitive(i, 0), in3(i, 11)));
}
FN ProbeOut probe_surface_disk(ProbeIn i) {
    vec2 d = disk_uniform(in2(i, 11));
    return out_surface(surface_disk(in_Primitive(i, 0), d.x, d.y));
}
FN ProbeOut probe_spherical_triangle(ProbeIn i) {
    vec2 u = in2(i, 9);
    SphericalTriangle t = spherical_triangle(in3(i, 0), in3(i, 3), in3(i, 6), u.x == u.x);
    vec3 w = spherical_triangle_uniform(t, u);
    vec3 e1 = sub3(in3(i, 3), in3(i, 0)), e2 = sub3(in3(i, 6), in3(i, 0));
    return put2(put3(out1(t.solid_angle), 1, w), 4, plane_coordinates(in3(i, 0), e1, e2, w));
}
FN ProbeOut probe_shading_side(ProbeIn i) {
    ShadingSide s = shading_side(in3(i, 0), in3(i, 3), in3(i, 6));
    ProbeOut o = put3(out3(s.n), 3, s.g);
    return put2(o, 6, v2(consistent_share(s, in3(i, 9)), softened_share(s, in3(i, 9))));
}
FN ProbeOut probe_camera_ray(ProbeIn i) {
    CameraRay r = camera_ray(in_Camera(i, 0), v2(i.w[30] * R(1000.), i.w[31] * R(1000.)),
                             disk_uniform(in2(i, 32)));
    return put1(put3(out3(r.origin), 3, r.direction), 6, r.t_max);
}

// The lists below are tables.
// clang-format off
#define PROBES                                                                                     \
    PROBE(intersect_triangle, "pppcccr", 4) PROBE(triangle_blocks, "pppcccr", 1)                   \
    PROBE(intersect_triangle_through_corners, "pppud", 4)                                          \
    PROBE(triangle_started_on, "pppduu", 5) PROBE(plane_side, "pppduu", 2)                        \
    PROBE(intersect_sphere, "pps", 4)                                                              \
    PROBE(intersect_cylinder, "pddss", 4)                                                          \
    PROBE(intersect_disk, "pppp", 4)                                                               \
    PROBE(box_overlap, "rrrrrrr", 2) PROBE(ray_slab, "rrr", 3)                                     \
        PROBE(leave_surface, "ppdd", 3)                                                            \
        PROBE(surface_triangle, "guu", 23) PROBE(surface_vertex_attributes, "gvuu", 23)            \
            PROBE(surface_sphere, "gp", 23) PROBE(surface_disk, "guu", 23)                         \
            PROBE(surface_cylinder, "gp", 23)                                                      \
                PROBE(spherical_triangle, "pppuu", 6) PROBE(camera_ray, "kuuuu", 7)          \
                    PROBE(shading_side, "dddd", 8)
