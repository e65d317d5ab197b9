// The tree of boxes that rays walk: 16 children a node, up to 16 primitives of one kind a leaf
// (layout: BvhNode, BvhLeaf, BvhPatch).
#pragma once

#include "host/bvh/geometry.h"
#include "host/large_vector.h"
#include "kernels/shared/types.h"

#include <cstddef>
#include <span>

namespace parhelion {

/// One or several trees, which share the two arrays.
struct Bvh {
    LargeVector<BvhNode> nodes;
    LargeVector<BvhLine> leaves;
    float side = 0; ///< TreeSizes::side (kernels/shared/types.h), of all trees
};

/// What one call of bvh_append made.
struct BvhStatistics {
    double build_seconds = 0;
    double sah_cost = 0; ///< expected cost of a ray through the root's box, in visits of a node
    std::size_t node_count = 0, leaf_count = 0, bytes = 0;
    int depth = 0;         ///< nodes on the longest way down; 0 where the root is a leaf
    int stack_entries = 0; ///< most children that can wait at once when every box is hit
    double leaf_fill = 0;  ///< used share of the leaves' places, 0 to 1
};

/// Builds a tree over the primitives numbered in `subset` and appends it to bvh; returns the root
/// as a child code:
/// >= 0 a node, < 0 a leaf (as in BvhNode). Triangles without area are left out: no ray hits them.
/// An empty subset gives a node whose 16 children are empty. The result is the same bits for any
/// number of threads. A tree that would need more than `stack_limit` stack entries is built again
/// by halving, which needs at most 15 (log2(n) + 3). Coordinates are finite; at most 2^28 lines of
/// leaves in bvh.
int bvh_append(Bvh& bvh, const IndexedGeometry& geometry, std::span<const int> subset,
               BvhStatistics* statistics = nullptr, int stack_limit = BVH_STACK);

/// The same over all primitives.
int bvh_append(Bvh& bvh, const IndexedGeometry& geometry, BvhStatistics* statistics = nullptr,
               int stack_limit = BVH_STACK);

/// The largest side of a box around all triangles below `root`.
float bvh_extent(const Bvh& bvh, int root);

} // namespace parhelion
