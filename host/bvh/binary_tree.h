// A tree of two children a node over references to primitives; the wide tree is made from it.
#pragma once

#include "host/bvh/bounds.h"
#include "host/large_vector.h"

namespace parhelion {

struct BinaryNode {
    Box box;
    int children;     ///< the first of two neighbours in `nodes`; -1: none
    int first, count; ///< the references below
    int kind;         ///< geometry kind of all references below, -1 if there are several

    bool fits_leaf() const { return count <= BVH_WIDTH && kind >= 0; }
};

struct BinaryTree {
    LargeVector<Reference> references;
    LargeVector<BinaryNode> nodes; ///< the root first; the order of the others depends on the
                                   ///< threads, the tree does not
};

enum class SplitMethod { surface_area, halves };

/// A tree over at least one reference; a node without children fits a leaf of the wide tree.
BinaryTree build_binary_tree(LargeVector<Reference> references, SplitMethod method);

} // namespace parhelion
