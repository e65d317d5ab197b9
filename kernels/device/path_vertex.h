// What a packet of paths has reached: the state of each and the surface it is on, and whether it
// has met anything yet that covers its pixel.
#ifndef PARHELION_PATH_VERTEX_H
#define PARHELION_PATH_VERTEX_H

/// The camera's path or a later vertex, one packet of it.
typedef struct {
    vec3 origin, direction, throughput;
    Real t, pdf, eta_scale, b1, b2;
    Int slot, pixel, sample, primitive;
    Mask active, hit;
} PathVertex;

FN PathVertex load_vertex_state(global const Scalar* path_state, RenderParams params, int at,
                                int left) {
    PathVertex v;
    v.active = active_lanes(left);
    v.origin = v3(PATH_LOAD_REAL(ox), PATH_LOAD_REAL(oy), PATH_LOAD_REAL(oz));
    v.direction = v3(PATH_LOAD_REAL(dx), PATH_LOAD_REAL(dy), PATH_LOAD_REAL(dz));
    v.throughput = v3(PATH_LOAD_REAL(tr), PATH_LOAD_REAL(tg), PATH_LOAD_REAL(tb));
    v.t = PATH_LOAD_REAL(t);
    v.pdf = PATH_LOAD_REAL(pdf);
    v.eta_scale = PATH_LOAD_REAL(eta_scale);
    v.b1 = PATH_LOAD_REAL(b1);
    v.b2 = PATH_LOAD_REAL(b2);
    v.slot = PATH_LOAD_INT(slot);
    v.pixel = PATH_LOAD_INT(pixel);
    v.sample = PATH_LOAD_INT(sample);
    // Lanes behind the last path hold leftovers: they count as misses, and primitive 0 stands in
    // for what they hit.
    Int primitive = PATH_LOAD_INT(primitive);
    v.hit = v.active & (primitive >= 0);
    v.primitive = sel(v.hit, primitive, (Int)0);
    return v;
}

FN SurfaceInteraction surface_at(Primitive p, PathVertex v, global const VertexRecord* vertices) {
    SurfaceInteraction s = surface_triangle(p, v.b1, v.b2);
    if (HAS(vertex_normals) || HAS(vertex_uvs)) {
        Mask has_attributes = (p.flags & (PRIMITIVE_NORMALS | PRIMITIVE_UVS)) != 0;
        if (someLane(has_attributes & v.hit)) {
            Vertex attributes = load_Vertex(vertices, sel(has_attributes, v.primitive, (Int)0));
            s = surface_vertex_attributes(s, p, attributes, v.b1, v.b2);
        }
    }
    if (HAS(shape_sphere)) {
        Mask mine = primitive_kind(p) == geometry_sphere;
        if (someLane(mine))
            s = sel_surface(mine, surface_sphere(p, add3(v.origin, scale3(v.direction, v.t))), s);
    }
    if (HAS(shape_disk)) {
        Mask mine = primitive_kind(p) == geometry_disk;
        if (someLane(mine)) s = sel_surface(mine, surface_disk(p, v.b1, v.b2), s);
    }
    return s;
}

/// Paths that have met nothing yet but what let them straight through. Alpha tells: it is 0 for
/// them.
FN Mask uncovered(global const Scalar* results, long stride, PathVertex v) {
    return v.active & (gather(results + result_alpha * stride, v.slot) == R(0.));
}

/// The lanes cover their pixels. What went wrong before has its own use for alpha.
FN void cover(global Scalar* results, long stride, PathVertex v, Mask lanes) {
    Real weight = gather(results + result_weight * stride, v.slot);
    Mask newly = lanes & uncovered(results, stride, v) & (weight == weight);
    scatter_add(results + result_alpha * stride, v.slot, R(1.), maskBits(newly));
}

/// Of the lanes, those on a surface that may let their rays straight through.
FN Mask passing_surface(Mask lanes, Material m) {
    return lanes & (((((Int)1) << m.kind) & PASSING_MATERIALS) != 0);
}

#endif
