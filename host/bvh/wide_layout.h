// Writes a collapsed binary tree as the nodes and leaves that the kernels read.
#pragma once

#include "host/bvh/bvh.h"
#include "host/bvh/collapse.h"

#include <span>
#include <vector>

namespace parhelion {

/// The references of one leaf, as a range of BinaryTree::references.
struct LeafRange {
    int first, count;
};

struct WideTree {
    int root; ///< a child code
    int depth, stack_entries;
    std::vector<LeafRange> leaves; ///< numbered from bvh.leaves.size() on, but not there yet
};

/// Appends the nodes to bvh.nodes, each before its children, and numbers the leaves.
WideTree append_nodes(Bvh& bvh, const BinaryTree& tree, const CollapsePlan& plan);

/// Appends a node whose 16 children are empty; returns its number.
int append_empty_node(Bvh& bvh);

/// Appends the leaves that append_nodes has numbered.
void append_leaves(Bvh& bvh, const BinaryTree& tree, std::span<const LeafRange> leaves,
                   std::span<const PrimitiveRecord> primitives);

} // namespace parhelion
