// Rays against every primitive, and down the wide tree, on the host with the maths the kernels use.
#pragma once

#include "host/bvh/bvh.h"
#include "host/bvh/leaf_reader.h"
#include "host/shared_maths.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <limits>
#include <span>
#include <vector>

namespace parhelion::rays {

using Vector = std::array<float, 3>;

struct Ray {
    Vector origin, direction;
};

struct Hit {
    float t = std::numeric_limits<float>::infinity();
    int primitive = -1;
    float rank = std::numeric_limits<float>::infinity(); ///< f32::Intersection

    bool operator==(const Hit&) const = default;
};

/// A ray made ready, as traversal_ray in kernels/device/traverse.h does.
struct ReadyRay {
    Ray ray;
    std::array<f32::RaySlab, 3> slab;
    std::array<int, 3> axis;
    f32::RayShear shear;

    explicit ReadyRay(const Ray& r, TreeSizes sizes = {0, 0}) : ray(r) {
        Vector size;
        for (int a = 0; a < 3; a++)
            size[a] = std::fabs(r.direction[a]);
        float largest = std::max({size[0], size[1], size[2]});
        for (int a = 0; a < 3; a++)
            slab[a] = f32::ray_slab(r.origin[a], r.direction[a], largest, sizes);
        int z = size[0] > size[1] ? (size[0] > size[2] ? 0 : 2) : (size[1] > size[2] ? 1 : 2);
        axis = {(z + 1) % 3, (z + 2) % 3, z};
        shear.origin = renamed(r.origin[0], r.origin[1], r.origin[2]);
        shear.shear_x = r.direction[axis[0]] / r.direction[z];
        shear.shear_y = r.direction[axis[1]] / r.direction[z];
        shear.shear_z = 1.f / r.direction[z];
        shear.doubt = std::numeric_limits<float>::infinity();
    }

    f32::vec3 renamed(float x, float y, float z) const {
        Vector v{x, y, z};
        return f32::v3(v[axis[0]], v[axis[1]], v[axis[2]]);
    }
};

inline f32::vec3 to_vec3(const Vector& v) { return f32::v3(v[0], v[1], v[2]); }

/// One primitive, given as a leaf's column of nine numbers.
inline f32::Intersection intersect(int kind, const std::array<float, 9>& p, const ReadyRay& r,
                                   float t_max, bool flipped = false) {
    f32::vec3 origin = to_vec3(r.ray.origin), direction = to_vec3(r.ray.direction),
              centre = f32::v3(p[0], p[1], p[2]);
    if (kind == geometry_sphere)
        return f32::ranked(f32::intersect_sphere(f32::sub3(origin, centre), direction, p[3], t_max),
                           flipped);
    if (kind == geometry_disk)
        return f32::ranked(f32::intersect_disk(f32::sub3(centre, origin), direction,
                                               f32::v3(p[3], p[4], p[5]), f32::v3(p[6], p[7], p[8]),
                                               t_max),
                           flipped);
    if (kind == geometry_cylinder)
        return f32::ranked(f32::intersect_cylinder(f32::sub3(origin, centre), direction,
                                                   f32::v3(p[3], p[4], p[5]), p[6], p[7], t_max),
                           flipped);
    f32::Corners corners = {r.renamed(p[0], p[1], p[2]), r.renamed(p[3], p[4], p[5]),
                            r.renamed(p[6], p[7], p[8])};
    return f32::intersect_triangle(corners, r.shear, t_max);
}

/// The hit of least rank wins, of equal ones that of the lower number.
inline void take(Hit& hit, const f32::Intersection& i, int primitive) {
    if (!i.hit || i.rank > hit.rank) return;
    if (i.rank < hit.rank || hit.primitive < 0 || primitive < hit.primitive)
        hit = {i.t, primitive, i.rank};
}

inline int kind_of(const PrimitiveRecord& p) { return p.flags & PRIMITIVE_KIND_MASK; }

inline std::array<float, 9> column_of(const PrimitiveRecord& p) {
    if (kind_of(p) == geometry_sphere) return {p.ax, p.ay, p.az, p.extra};
    if (kind_of(p) == geometry_cylinder) {
        double x = p.bx, y = p.by, z = p.bz, height = std::sqrt(x * x + y * y + z * z);
        return {p.ax,
                p.ay,
                p.az,
                static_cast<float>(x * (1 / height)),
                static_cast<float>(y * (1 / height)),
                static_cast<float>(z * (1 / height)),
                std::fabs(p.extra),
                static_cast<float>(height)};
    }
    return {p.ax, p.ay, p.az, p.bx, p.by, p.bz, p.cx, p.cy, p.cz};
}

inline Hit brute_force(std::span<const PrimitiveRecord> primitives, const Ray& ray) {
    ReadyRay ready(ray);
    Hit hit;
    for (std::size_t i = 0; i < primitives.size(); i++)
        take(hit,
             intersect(kind_of(primitives[i]), column_of(primitives[i]), ready, hit.rank,
                       primitives[i].flags & PRIMITIVE_FLIPPED),
             int(i));
    return hit;
}

/// A leaf of either form, read back; absent places are zero, with primitive -1.
struct Leaf {
    int kind, lines;
    std::array<std::array<float, 9>, BVH_WIDTH> column{};
    std::array<int, BVH_WIDTH> primitive;
    std::array<bool, BVH_WIDTH> flipped{}; ///< what is no triangle
};

inline Leaf read_leaf(const Bvh& bvh, int child) {
    LeafReader reader(&bvh.leaves.at(std::size_t(BVH_LEAF_LINE(child))), child);
    Leaf leaf{reader.kind(), reader.lines(), {}, {}, {}};
    for (int k = 0; k < BVH_WIDTH; k++) {
        auto at = std::size_t(k);
        leaf.primitive[at] = reader.primitive(k);
        leaf.column[at] = reader.column(k);
        leaf.flipped[at] = reader.flipped(k);
    }
    return leaf;
}

/// Whether the ray meets the box of child k before t_max, as node_overlap does; and where it
/// enters.
inline bool meets_box(const BvhNode& node, int k, const ReadyRay& r, float t_max, float& entry) {
    Vector near, far;
    for (int a = 0; a < 3; a++) {
        const f32::RaySlab& slab = r.slab[a];
        bool negative = slab.inverse < 0.f;
        near[a] = std::fma(node.bounds[2 * a + negative][k], slab.inverse, slab.near_offset);
        far[a] = std::fma(node.bounds[2 * a + 1 - negative][k], slab.inverse, slab.far_offset);
    }
    f32::BoxOverlap box =
        f32::box_overlap(near[0], near[1], near[2], far[0], far[1], far[2], t_max);
    entry = box.entry;
    return box.meets;
}

/// Closest hit below `root`; `peak` becomes the most entries that ever waited. A child is skipped
/// if its box begins behind the hit when its turn comes, as in the kernels.
inline Hit walk(const Bvh& bvh, int root, const Ray& ray, std::size_t* peak = nullptr) {
    struct Entry {
        int child;
        float entry;
    };
    ReadyRay ready(ray, {bvh_extent(bvh, root), bvh.side});
    Hit hit;
    std::vector<Entry> stack{{root, -std::numeric_limits<float>::infinity()}};
    while (!stack.empty()) {
        Entry current = stack.back();
        stack.pop_back();
        if (current.entry > hit.rank * float(HIT_WIDENING)) continue;
        if (current.child < 0) {
            Leaf leaf = read_leaf(bvh, current.child);
            for (std::size_t k = 0; k < BVH_WIDTH; k++)
                if (leaf.primitive[k] >= 0)
                    take(hit,
                         intersect(leaf.kind, leaf.column[k], ready, hit.rank, leaf.flipped[k]),
                         leaf.primitive[k]);
            continue;
        }
        const BvhNode& node = bvh.nodes[std::size_t(current.child)];
        std::size_t first = stack.size();
        for (int k = 0; k < BVH_WIDTH; k++) {
            float entry;
            if (!meets_box(node, k, ready, hit.rank * float(HIT_WIDENING), entry)) continue;
            stack.push_back({node.child[k], entry});
            bool nearest = stack.size() == first + 1 || entry < stack[stack.size() - 2].entry;
            if (!nearest) std::swap(stack.back(), stack[stack.size() - 2]);
        }
        if (peak && stack.size() > first) *peak = std::max(*peak, stack.size() - 1);
    }
    return hit;
}

} // namespace parhelion::rays
