// Writes a collapsed binary tree as the nodes and leaves that the kernels read.
#pragma once

#include "host/bvh/bvh.h"
#include "host/bvh/collapse.h"

#include <span>

namespace parhelion {

/// What a wide tree needs.
struct WideExtent {
    int nodes = 0, leaves = 0, leaf_lines = 0;
    int depth = 0, stack_entries = 0;
};

/// The wide tree that a plan makes of a binary tree, before it is written.
struct WideTree {
    WideExtent extent;
    LargeVector<int> nodes_below; ///< of each binary node that becomes a wide one
    LargeVector<int> lines_below; ///< of leaves; of each binary node that becomes a node or a leaf
};

WideTree measure_wide_tree(const BinaryTree& tree, const CollapsePlan& plan,
                           const IndexedGeometry& geometry);

/// Appends nodes (each before its children) and leaves to bvh; returns the root as a child code.
int append_wide_tree(Bvh& bvh, const BinaryTree& tree, const CollapsePlan& plan,
                     const WideTree& wide, const IndexedGeometry& geometry);

/// Appends a node whose 16 children are empty; returns its number.
int append_empty_node(Bvh& bvh);

} // namespace parhelion
