// Packing of up to 16 primitives into the lines of a leaf.
#include "host/bvh/leaf_layout.h"

#include "host/bvh/leaf_reader.h"
#include "kernels/shared/features.h"

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <optional>

namespace parhelion {
namespace {

static_assert(geometry_kind_count <= BVH_PATCH && geometry_kind_count <= PRIMITIVE_KIND_MASK + 1);

constexpr int lines_of(std::size_t bytes) { return int(bytes / sizeof(BvhLine)); }

PrimitiveRecord primitive_of(const Reference& reference, const IndexedGeometry& geometry) {
    return geometry.primitive(reference.primitive());
}

/// Corners in the order in which they are first met; those with the same bits are one.
class CornerTable {
public:
    /// The corner's place; BVH_WIDTH: there is none left.
    int place(float x, float y, float z) {
        auto a = std::bit_cast<std::uint32_t>(x), b = std::bit_cast<std::uint32_t>(y),
             c = std::bit_cast<std::uint32_t>(z);
        for (int i = 0; i < count_; i++)
            if (x_[i] == a && y_[i] == b && z_[i] == c) return i;
        if (count_ == BVH_WIDTH) return BVH_WIDTH;
        x_[count_] = a, y_[count_] = b, z_[count_] = c;
        return count_++;
    }

    void write(BvhPatch& patch) const {
        std::memcpy(patch.corner[0], x_, sizeof x_);
        std::memcpy(patch.corner[1], y_, sizeof y_);
        std::memcpy(patch.corner[2], z_, sizeof z_);
    }

private:
    int count_ = 0;
    std::uint32_t x_[BVH_WIDTH]{}, y_[BVH_WIDTH]{}, z_[BVH_WIDTH]{};
};

/// The corners of a triangle as a patch has them, which are not one point (that reads as absent);
/// nothing where they do not fit.
std::optional<std::uint32_t> corner_bits(const PrimitiveRecord& p, CornerTable& corners) {
    int a = corners.place(p.ax, p.ay, p.az), b = corners.place(p.bx, p.by, p.bz),
        c = corners.place(p.cx, p.cy, p.cz);
    if (std::max({a, b, c}) == BVH_WIDTH) return std::nullopt;
    return std::uint32_t(a | b << 4 | c << 8);
}

/// Bit k says whether word k of a leaf has BVH_SIZE_BIT: the upper half of a float above all sides
/// of the triangles.
std::uint32_t size_bits(std::span<const Reference> references, const IndexedGeometry& geometry) {
    float longest = 0;
    for (const Reference& r : references)
        longest = std::max(longest, longest_side(primitive_of(r, geometry)));
    return (std::bit_cast<std::uint32_t>(longest) >> 16) + 1;
}

std::optional<BvhPatch> make_patch(std::span<const Reference> references,
                                   const IndexedGeometry& geometry) {
    if (references.front().kind() != geometry_triangle) return std::nullopt;
    auto [lowest, highest] =
        std::minmax_element(references.begin(), references.end(),
                            [](auto& a, auto& b) { return a.primitive() < b.primitive(); });
    auto base = std::uint32_t(lowest->primitive()) >> BVH_PATCH_BASE;
    auto first = int(base << BVH_PATCH_BASE);
    if (highest->primitive() - first >= 1 << BVH_PATCH_NUMBERS) return std::nullopt;
    BvhPatch patch{};
    CornerTable corners;
    std::uint32_t size = size_bits(references, geometry);
    for (std::size_t k = 0; k < BVH_WIDTH; k++) {
        std::uint32_t word = (base >> k & 1) << 31 | (size >> k & 1) << BVH_SIZE_BIT;
        if (k < references.size()) {
            auto bits = corner_bits(primitive_of(references[k], geometry), corners);
            if (!bits) return std::nullopt;
            word |= *bits | std::uint32_t(references[k].primitive() - first) << BVH_PATCH_CORNERS;
        }
        patch.triangle[k] = int(word);
    }
    corners.write(patch);
    return patch;
}

std::array<float, 9> leaf_column(const PrimitiveRecord& p) {
    if (geometry_kind(p) == geometry_sphere) return {p.ax, p.ay, p.az, p.extra};
    if (geometry_kind(p) == geometry_cylinder) {
        glm::dvec3 axis(p.bx, p.by, p.bz);
        glm::vec3 unit(glm::normalize(axis));
        return {
            p.ax, p.ay, p.az, unit.x, unit.y, unit.z, std::fabs(p.extra), float(glm::length(axis))};
    }
    return {p.ax, p.ay, p.az, p.bx, p.by, p.bz, p.cx, p.cy, p.cz};
}

BvhLeaf make_leaf(std::span<const Reference> references, const IndexedGeometry& geometry) {
    BvhLeaf leaf{};
    bool triangles = references.front().kind() == geometry_triangle;
    if (triangles)
        std::fill_n(leaf.rows[0], 9 * BVH_WIDTH, std::numeric_limits<float>::quiet_NaN());
    std::uint32_t size = triangles ? size_bits(references, geometry) : 0;
    for (std::size_t i = 0; i < BVH_WIDTH; i++) {
        int bit = int(size >> i & 1) << BVH_SIZE_BIT;
        if (i >= references.size()) {
            leaf.primitive[i] = std::numeric_limits<int>::min() | bit;
            continue;
        }
        PrimitiveRecord primitive = primitive_of(references[i], geometry);
        std::array<float, 9> column = leaf_column(primitive);
        for (std::size_t row = 0; row < column.size(); row++)
            leaf.rows[row][i] = column[row];
        if (primitive.flags & PRIMITIVE_FLIPPED) bit |= 1 << BVH_SIZE_BIT;
        leaf.primitive[i] = references[i].primitive() | bit;
    }
    return leaf;
}

template<class Leaf>
int put(Bvh& bvh, int line, const Leaf& leaf, int form) {
    std::memcpy(static_cast<void*>(&bvh.leaves[std::size_t(line)]), &leaf, sizeof leaf);
    return BVH_LEAF_CODE(line, form);
}

} // namespace

int leaf_lines(std::span<const Reference> references, const IndexedGeometry& geometry) {
    return lines_of(make_patch(references, geometry) ? sizeof(BvhPatch) : sizeof(BvhLeaf));
}

int write_leaf(Bvh& bvh, int line, std::span<const Reference> references,
               const IndexedGeometry& geometry) {
    if (auto patch = make_patch(references, geometry)) return put(bvh, line, *patch, BVH_PATCH);
    return put(bvh, line, make_leaf(references, geometry), references.front().kind());
}

Box leaf_box(const Bvh& bvh, int child) {
    LeafReader leaf(&bvh.leaves[std::size_t(BVH_LEAF_LINE(child))], child);
    Box box = empty_box();
    for (int k = 0; k < BVH_WIDTH; k++) {
        if (leaf.primitive(k) < 0) continue;
        std::array<float, 9> p = leaf.column(k);
        for (std::size_t corner = 0; corner < 9; corner += 3) {
            Float4 point{p[corner], p[corner + 1], p[corner + 2]};
            box = box_union(box, {point, point});
        }
    }
    return box;
}

} // namespace parhelion
