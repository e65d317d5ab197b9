// Which nodes of a binary tree become nodes of the wide tree, so that the expected cost of a ray is
// least.
#pragma once

#include "host/bvh/binary_tree.h"

#include <array>
#include <cstdint>

namespace parhelion {

/// Decisions for one binary node. Its subtree may be represented by up to `roots` wide children;
/// how many of them its first child gets is left_roots[roots]. Meaning of the entries: [1] 0: a
/// leaf; 1: a wide node. [2..15] 0: no better than one root less. [16] the division inside a wide
/// node; never 0.
struct CollapseChoice {
    std::array<std::uint8_t, BVH_WIDTH + 1> left_roots;
};

struct CollapsePlan {
    LargeVector<CollapseChoice> choices; ///< for each binary node
    double sah_cost;                     ///< of the wide tree, in visits of a node
};

/// Dynamic programming over the binary tree (Pinto 2010, "Adaptive collapsing on bounding volume
/// hierarchies for ray tracing").
CollapsePlan plan_collapse(const BinaryTree& tree);

} // namespace parhelion
