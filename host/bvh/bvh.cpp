// From primitives to a finished tree: references, binary tree, collapse, layout.
#include "host/bvh/bvh.h"

#include "host/bvh/binary_tree.h"
#include "host/bvh/collapse.h"
#include "host/bvh/leaf_layout.h"
#include "host/bvh/wide_layout.h"
#include "host/parallel.h"
#include "kernels/shared/features.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <cstdint>

namespace parhelion {
namespace {

/// The longest side of triangles that are not much larger than most: at most 2^9 times their mean,
/// that of exponents, which a few large ones do not move.
template<class NumberOf>
float usual_side(const IndexedGeometry& geometry, std::size_t count, const NumberOf& number_of) {
    struct Sides {
        std::int64_t exponents = 0, triangles = 0;
        float longest = 0;
    };
    auto add = [&](Sides sum, std::size_t i) {
        PrimitiveRecord p = geometry.primitive(number_of(i));
        float side = longest_side(p);
        if (geometry_kind(p) != geometry_triangle || !(side > 0 && std::isfinite(side))) return sum;
        return Sides{sum.exponents + std::ilogb(side), sum.triangles + 1,
                     std::max(sum.longest, side)};
    };
    auto join = [](const Sides& a, const Sides& b) {
        return Sides{a.exponents + b.exponents, a.triangles + b.triangles,
                     std::max(a.longest, b.longest)};
    };
    Sides all = parallel_sum(count, Sides{}, add, join);
    if (all.triangles == 0) return 0;
    return std::min(all.longest, std::ldexp(1.f, int(all.exponents / all.triangles) + 9));
}

/// Of all primitives that can be hit.
template<class NumberOf>
LargeVector<Reference> make_references(const IndexedGeometry& geometry, std::size_t count,
                                       const NumberOf& number_of, float side) {
    LargeVector<Reference> references(count);
    std::atomic<bool> all = true;
    parallel_for(count, [&](std::size_t i) {
        int number = number_of(i);
        PrimitiveRecord primitive = geometry.primitive(number);
        references[i] = make_reference(primitive, number, side);
        if (!can_be_hit(primitive)) all = false;
    });
    if (!all)
        std::erase_if(references, [&](const Reference& r) {
            return !can_be_hit(geometry.primitive(r.primitive()));
        });
    return references;
}

struct Built {
    int root;
    double sah_cost = 0;
    WideExtent extent;
};

/// Builds a tree and appends it whole, or, where it needs more stack than allowed and may be
/// refused, not at all.
bool append_tree(Bvh& bvh, const IndexedGeometry& geometry, BinaryTree& tree, int stack_limit,
                 bool may_refuse, Built& built) {
    CollapsePlan plan = plan_collapse(tree);
    WideTree wide = measure_wide_tree(tree, plan, geometry);
    if (may_refuse && wide.extent.stack_entries > stack_limit) return false;
    int root = append_wide_tree(bvh, tree, plan, wide, geometry);
    built = {root, plan.sah_cost, wide.extent};
    return true;
}

Built append_references(Bvh& bvh, const IndexedGeometry& geometry,
                        LargeVector<Reference> references, int stack_limit) {
    if (references.empty()) return {append_empty_node(bvh), 0, {.nodes = 1, .depth = 1}};
    Built built;
    BinaryTree tree = build_binary_tree(std::move(references), SplitMethod::surface_area);
    if (append_tree(bvh, geometry, tree, stack_limit, true, built)) return built;
    tree = build_binary_tree(std::move(tree.references), SplitMethod::halves);
    append_tree(bvh, geometry, tree, stack_limit, false, built);
    return built;
}

template<class NumberOf>
int append_timed(Bvh& bvh, const IndexedGeometry& geometry, std::size_t count,
                 const NumberOf& number_of, BvhStatistics* statistics, int stack_limit) {
    auto start = std::chrono::steady_clock::now();
    float side = usual_side(geometry, count, number_of);
    bvh.side = std::max(bvh.side, side);
    LargeVector<Reference> references = make_references(geometry, count, number_of, side);
    std::size_t used = references.size();
    Built built = append_references(bvh, geometry, std::move(references), stack_limit);
    if (statistics) {
        BvhStatistics s;
        const WideExtent& extent = built.extent;
        s.node_count = std::size_t(extent.nodes);
        s.leaf_count = std::size_t(extent.leaves);
        s.bytes = s.node_count * sizeof(BvhNode) + std::size_t(extent.leaf_lines) * sizeof(BvhLine);
        s.sah_cost = built.sah_cost;
        s.depth = extent.depth;
        s.stack_entries = extent.stack_entries;
        s.leaf_fill = s.leaf_count ? double(used) / double(s.leaf_count * BVH_WIDTH) : 0;
        s.build_seconds =
            std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
        *statistics = s;
    }
    return built.root;
}

/// Around all children; those that are absent are inside out.
Box node_box(const BvhNode& node) {
    Box box = empty_box();
    for (std::size_t k = 0; k < BVH_WIDTH; k++)
        box = box_union(box, {Float4{node.bounds[0][k], node.bounds[2][k], node.bounds[4][k]},
                              Float4{node.bounds[1][k], node.bounds[3][k], node.bounds[5][k]}});
    return box;
}

} // namespace

int bvh_append(Bvh& bvh, const IndexedGeometry& geometry, std::span<const int> subset,
               BvhStatistics* statistics, int stack_limit) {
    auto number_of = [subset](std::size_t i) { return subset[i]; };
    return append_timed(bvh, geometry, subset.size(), number_of, statistics, stack_limit);
}

int bvh_append(Bvh& bvh, const IndexedGeometry& geometry, BvhStatistics* statistics,
               int stack_limit) {
    auto number_of = [](std::size_t i) { return int(i); };
    return append_timed(bvh, geometry, geometry.primitives.size(), number_of, statistics,
                        stack_limit);
}

float bvh_extent(const Bvh& bvh, int root) {
    Box box = root < 0 ? leaf_box(bvh, root) : node_box(bvh.nodes[std::size_t(root)]);
    Float4 sides = box.high - box.low;
    return std::max({sides[0], sides[1], sides[2], 0.f});
}

} // namespace parhelion
