// Packing of up to 16 primitives into the lines of a leaf.
#pragma once

#include "host/bvh/bounds.h"
#include "host/bvh/bvh.h"

#include <span>

namespace parhelion {

/// Lines that a leaf over these references, all of one kind, takes: those of a BvhPatch where the
/// triangles share corners enough and their numbers lie close together, else of a BvhLeaf.
int leaf_lines(std::span<const Reference> references, const IndexedGeometry& geometry);

/// Writes the leaf to the lines from `line` on; returns its child code.
int write_leaf(Bvh& bvh, int line, std::span<const Reference> references,
               const IndexedGeometry& geometry);

/// Around the corners of all triangles of a leaf, given by its child code.
Box leaf_box(const Bvh& bvh, int child);

} // namespace parhelion
