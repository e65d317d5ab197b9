// What stands in a leaf, whichever its form: the one place of the host that reads them.
#pragma once

#include "kernels/shared/features.h"
#include "kernels/shared/types.h"

#include <array>
#include <cstddef>

namespace parhelion {

/// The leaf that a child code below 0 names; `lines`: its first.
class LeafReader {
public:
    LeafReader(const BvhLine* lines, int code)
        : patch_(reinterpret_cast<const BvhPatch*>(lines)),
          leaf_(reinterpret_cast<const BvhLeaf*>(lines)), form_(BVH_LEAF_FORM(code)) {
        if (is_patch())
            for (int k = 0; k < BVH_WIDTH; k++)
                base_ |= int(patch_->triangle[k] < 0) << (k + BVH_PATCH_BASE);
    }

    bool is_patch() const { return form_ == BVH_PATCH; }
    int lines() const {
        return int((is_patch() ? sizeof(BvhPatch) : sizeof(BvhLeaf)) / sizeof(BvhLine));
    }
    /// enum GeometryKind
    int kind() const { return is_patch() ? int(geometry_triangle) : form_; }

    /// Of primitive k; -1 where there is none.
    int primitive(int k) const {
        if (!is_patch()) {
            int word = leaf_->primitive[k];
            return word < 0 ? -1 : BVH_LEAF_NUMBER(word);
        }
        int word = patch_->triangle[k];
        if ((word & ((1 << BVH_PATCH_CORNERS) - 1)) == 0) return -1;
        return base_ + ((word >> BVH_PATCH_CORNERS) & ((1 << BVH_PATCH_NUMBERS) - 1));
    }

    /// What rays are tested against: a triangle's corners, rows of a BvhLeaf; zeros where there is
    /// no primitive k in a patch.
    std::array<float, 9> column(int k) const {
        std::array<float, 9> column{};
        for (std::size_t row = 0; row < 9; row++)
            if (!is_patch())
                column[row] = leaf_->rows[row][k];
            else if (primitive(k) >= 0)
                column[row] = patch_->corner[row % 3][patch_->triangle[k] >> (4 * (row / 3)) & 15];
        return column;
    }

    /// PRIMITIVE_FLIPPED, of what is no triangle.
    bool flipped(int k) const {
        return kind() != geometry_triangle && (leaf_->primitive[k] >> BVH_SIZE_BIT & 1);
    }

private:
    const BvhPatch* patch_;
    const BvhLeaf* leaf_;
    int form_, base_ = 0;
};

} // namespace parhelion
