// Packing of up to 16 primitives into the lines of a leaf.
#include "host/bvh/leaf_layout.h"

#include "kernels/shared/features.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <cstring>
#include <optional>

namespace parhelion {
namespace {

static_assert(BVH_PATCH == geometry_kind_count && BVH_PATCH <= PRIMITIVE_KIND_MASK);

constexpr int lines_of(std::size_t bytes) { return int(bytes / sizeof(BvhLine)); }

const PrimitiveRecord& primitive_of(const Reference& reference,
                                    std::span<const PrimitiveRecord> primitives) {
    return primitives[std::size_t(reference.primitive())];
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
std::uint32_t size_bits(std::span<const Reference> references,
                        std::span<const PrimitiveRecord> primitives) {
    float longest = 0;
    for (const Reference& r : references)
        longest = std::max(longest, longest_side(primitive_of(r, primitives)));
    return (std::bit_cast<std::uint32_t>(longest) >> 16) + 1;
}

std::optional<BvhPatch> make_patch(std::span<const Reference> references,
                                   std::span<const PrimitiveRecord> primitives) {
    if (references.front().kind() != geometry_triangle) return std::nullopt;
    auto [lowest, highest] =
        std::minmax_element(references.begin(), references.end(),
                            [](auto& a, auto& b) { return a.primitive() < b.primitive(); });
    auto base = std::uint32_t(lowest->primitive()) >> BVH_PATCH_BASE;
    auto first = int(base << BVH_PATCH_BASE);
    if (highest->primitive() - first >= 1 << BVH_PATCH_NUMBERS) return std::nullopt;
    BvhPatch patch{};
    CornerTable corners;
    std::uint32_t size = size_bits(references, primitives);
    for (std::size_t k = 0; k < BVH_WIDTH; k++) {
        std::uint32_t word = (base >> k & 1) << 31 | (size >> k & 1) << BVH_SIZE_BIT;
        if (k < references.size()) {
            auto bits = corner_bits(primitive_of(references[k], primitives), corners);
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
    return {p.ax, p.ay, p.az, p.bx, p.by, p.bz, p.cx, p.cy, p.cz};
}

BvhLeaf make_leaf(std::span<const Reference> references,
                  std::span<const PrimitiveRecord> primitives) {
    BvhLeaf leaf{};
    bool triangles = references.front().kind() == geometry_triangle;
    if (triangles)
        std::fill_n(leaf.rows[0], 9 * BVH_WIDTH, std::numeric_limits<float>::quiet_NaN());
    std::uint32_t size = triangles ? size_bits(references, primitives) : 0;
    for (std::size_t i = 0; i < BVH_WIDTH; i++) {
        int bit = int(size >> i & 1) << BVH_SIZE_BIT;
        if (i >= references.size()) {
            leaf.primitive[i] = std::numeric_limits<int>::min() | bit;
            continue;
        }
        const PrimitiveRecord& primitive = primitive_of(references[i], primitives);
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
    return ~((line << 2) | form);
}

template<class Leaf>
Leaf get(const Bvh& bvh, int child) {
    Leaf leaf;
    std::memcpy(&leaf, static_cast<const void*>(&bvh.leaves[std::size_t(~child >> 2)]),
                sizeof leaf);
    return leaf;
}

Box around(const Box& box, Float4 p) { return box_union(box, {p, p}); }

Box patch_box(const BvhPatch& patch) {
    Box box = empty_box();
    for (int word : patch.triangle)
        for (int corner = 0; corner < 3 && word << (32 - BVH_PATCH_CORNERS) != 0; corner++) {
            int k = (word >> (4 * corner)) & 15;
            box = around(box, Float4{patch.corner[0][k], patch.corner[1][k], patch.corner[2][k]});
        }
    return box;
}

Box rows_box(const BvhLeaf& leaf) {
    Box box = empty_box();
    for (std::size_t k = 0; k < BVH_WIDTH; k++)
        for (std::size_t row = 0; row < 9 && leaf.primitive[k] >= 0; row += 3)
            box = around(box,
                         Float4{leaf.rows[row][k], leaf.rows[row + 1][k], leaf.rows[row + 2][k]});
    return box;
}

} // namespace

int leaf_lines(std::span<const Reference> references, std::span<const PrimitiveRecord> primitives) {
    return lines_of(make_patch(references, primitives) ? sizeof(BvhPatch) : sizeof(BvhLeaf));
}

int write_leaf(Bvh& bvh, int line, std::span<const Reference> references,
               std::span<const PrimitiveRecord> primitives) {
    if (auto patch = make_patch(references, primitives)) return put(bvh, line, *patch, BVH_PATCH);
    return put(bvh, line, make_leaf(references, primitives), references.front().kind());
}

Box leaf_box(const Bvh& bvh, int child) {
    if ((~child & 3) == BVH_PATCH) return patch_box(get<BvhPatch>(bvh, child));
    return rows_box(get<BvhLeaf>(bvh, child));
}

} // namespace parhelion
