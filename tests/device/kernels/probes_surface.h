// Probes of intersection, surfaces, leaving them, and the camera.

FN ProbeOut out_intersection(Intersection i) {
    ProbeOut o = out1(mask_word(i.hit));
    // Where nothing is hit the rest is of no account.
    return put3(o, 1, sel3(i.hit, v3(i.t, i.b1, i.b2), splat3(R(0.))));
}
FN ProbeOut probe_intersect_triangle(ProbeIn i) {
    RayShear shear;
    shear.shear_x = i.w[9] * R(.01);
    shear.shear_y = i.w[10] * R(.01);
    shear.shear_z = i.w[11];
    return out_intersection(
        intersect_triangle(in3(i, 0), in3(i, 3), in3(i, 6), shear, absR(i.w[12])));
}
FN ProbeOut probe_intersect_triangle_through_corners(ProbeIn i) {
    vec3 a = in3(i, 0), b = in3(i, 3), c = in3(i, 6);
    RayShear shear; // through a corner, an edge or the inside of the triangle
    vec3 aim = add3(scale3(a, i.w[9]), scale3(b, R(1.) - i.w[9]));
    shear.shear_x = aim.x / aim.z;
    shear.shear_y = aim.y / aim.z;
    shear.shear_z = R(1.) / aim.z;
    return out_intersection(intersect_triangle(a, b, c, shear, LANE_INFINITY));
}
FN ProbeOut probe_triangle_blocks(ProbeIn i) {
    RayShear shear;
    shear.shear_x = i.w[9] * R(.01);
    shear.shear_y = i.w[10] * R(.01);
    shear.shear_z = i.w[11];
    vec3 a = shear_corner(in3(i, 0), shear), b = shear_corner(in3(i, 3), shear),
         c = shear_corner(in3(i, 6), shear);
    TriangleEdges e = triangle_edges(a, b, c);
    return out1(mask_word(triangle_blocks(e, a, b, c, shear, absR(i.w[12]))));
}
FN ProbeOut probe_intersect_sphere(ProbeIn i) {
    return out_intersection(intersect_sphere(in3(i, 0), in3(i, 3), i.w[6], LANE_INFINITY));
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
    RaySlab s = ray_slab(i.w[0], i.w[1], absR(i.w[2]));
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
    vec2 b = triangle_uniform(in2(i, 16));
    return out_surface(surface_triangle(in_Primitive(i, 0), b.x, b.y));
}
FN ProbeOut probe_surface_vertex_attributes(ProbeIn i) {
    vec2 b = triangle_uniform(in2(i, 32));
    Primitive p = in_Primitive(i, 0);
    return out_surface(
        surface_vertex_attributes(surface_triangle(p, b.x, b.y), p, in_Vertex(i, 16), b.x, b.y));
}
FN ProbeOut probe_surface_sphere(ProbeIn i) {
    return out_surface(surface_sphere(in_Primitive(i, 0), in3(i, 16)));
}
FN ProbeOut probe_surface_disk(ProbeIn i) {
    vec2 d = disk_uniform(in2(i, 16));
    return out_surface(surface_disk(in_Primitive(i, 0), d.x, d.y));
}
FN ProbeOut probe_camera_ray(ProbeIn i) {
    CameraRay r = camera_ray(in_Camera(i, 0), v2(i.w[21] * R(1000.), i.w[22] * R(1000.)),
                             disk_uniform(in2(i, 23)));
    return put1(put3(out3(r.origin), 3, r.direction), 6, r.t_max);
}

// The lists below are tables.
// clang-format off
#define PROBES                                                                                     \
    PROBE(intersect_triangle, "pppcccr", 4) PROBE(triangle_blocks, "pppcccr", 1)                   \
    PROBE(intersect_triangle_through_corners, "pppu", 4)                                           \
    PROBE(intersect_sphere, "pps", 4)                                                              \
    PROBE(intersect_disk, "pppp", 4)                                                               \
    PROBE(box_overlap, "rrrrrrr", 2) PROBE(ray_slab, "rrr", 3)                                     \
        PROBE(leave_surface, "ppdd", 3)                                                            \
        PROBE(surface_triangle, "guu", 23) PROBE(surface_vertex_attributes, "gvuu", 23)            \
            PROBE(surface_sphere, "gp", 23) PROBE(surface_disk, "guu", 23)                         \
                PROBE(camera_ray, "kuuuu", 7)
