// A ray's walk through the wide BVH, one box and one primitive at a time, for the double-precision
// kernels; text for the struct of kernels_double.cpp.
//
// It reads corners from the primitives' records and takes from the tree only its boxes, which bound
// them in any precision; its answer is that of all primitives tested one after the other.

struct PlainHit {
    Real t, b1, b2;
    int primitive; // -1: nothing
    Real rank;     // Intersection
};

Intersection plain_primitive(const PacketRay& r, const Primitive& p, Real t_max) {
    if (primitive_kind(p) == geometry_sphere)
        return ranked(intersect_sphere(sub3(r.origin, primitive_a(p)), r.direction, p.extra, t_max),
                      (p.flags & PRIMITIVE_FLIPPED) != 0);
    if (primitive_kind(p) == geometry_disk)
        return ranked(intersect_disk(sub3(primitive_a(p), r.origin), r.direction, primitive_b(p),
                                     primitive_c(p), t_max),
                      (p.flags & PRIMITIVE_FLIPPED) != 0);
    if (primitive_kind(p) == geometry_cylinder) {
        vec3 axis = primitive_b(p);
        return ranked(intersect_cylinder(sub3(r.origin, primitive_a(p)), r.direction,
                                         normalize3(axis), absR(p.extra), length3(axis), t_max),
                      (p.flags & PRIMITIVE_FLIPPED) != 0);
    }
    Corners v = {rename_axes(r, primitive_a(p)), rename_axes(r, primitive_b(p)),
                 rename_axes(r, primitive_c(p))};
    return intersect_triangle(v, r.shear, t_max);
}

BoxOverlap plain_box(const BvhNode& node, int k, const PacketRay& r, Real t_max) {
    auto plane = [&](int axis, const RaySlab& s, bool far) {
        int row = 2 * axis + (far != (s.inverse < 0));
        return fmaR(node.bounds[row][k], s.inverse, far ? s.far_offset : s.near_offset);
    };
    return box_overlap(plane(0, r.x, false), plane(1, r.y, false), plane(2, r.z, false),
                       plane(0, r.x, true), plane(1, r.y, true), plane(2, r.z, true), t_max);
}

/// The children that a ray meets wait; the one that it enters first comes last.
int plain_children(const BvhNode& node, const PacketRay& r, Real t_max, int* stack, int top) {
    std::array<std::pair<Real, int>, BVH_WIDTH> met;
    int count = 0;
    for (int k = 0; k < BVH_WIDTH; k++) {
        if (!(node.bounds[0][k] <= node.bounds[1][k])) continue; // no child
        BoxOverlap box = plain_box(node, k, r, t_max);
        if (box.meets) met[count++] = {box.entry, node.child[k]};
    }
    std::sort(met.begin(), met.begin() + count, std::greater<>());
    for (int i = 0; i < count; i++)
        stack[top++] = met[i].second;
    return top;
}

/// The hit of least rank in ]0, t_max], or with any_hit some hit; of two of one rank the lower
/// number.
PlainHit plain_walk(const SceneTables& scene, int root, const PacketRay& r, Real t_max,
                    int excluded, bool any_hit) {
    PlainHit hit = {t_max, 0, 0, -1, any_hit ? t_max : rank_of_end(t_max)};
    int stack[BVH_STACK];
    stack[0] = root;
    for (int top = 1; top > 0 && !(any_hit && hit.primitive >= 0);) {
        int code = stack[--top];
        if (code >= 0) {
            top = plain_children(AT(const BvhNode, scene.bvh_nodes, code), r,
                                 BOX_LIMIT(hit.rank, any_hit), stack, top);
            continue;
        }
        LeafReader leaf(IN_BUFFER(const BvhLine, scene.bvh_leaves, BVH_LEAF_LINE(code)), code);
        for (int k = 0; k < BVH_WIDTH; k++) {
            int number = leaf.primitive(k);
            if (number < 0 || number == excluded) continue;
            Primitive p = load_scene_primitive(scene, number).whole;
            Intersection i = plain_primitive(r, p, hit.rank);
            bool first = i.rank == hit.rank && (hit.primitive < 0 || number < hit.primitive);
            if (i.hit && (any_hit || i.rank < hit.rank || first))
                hit = {i.t, i.b1, i.b2, number, i.rank};
        }
    }
    return hit;
}
