// Boxes, and the references to primitives that the builder sorts.
#pragma once

#include "kernels/shared/types.h"

#include <bit>
#include <limits>

namespace parhelion {

/// Four floats side by side (a compiler extension of gcc and clang): the builder spends its time in
/// minima and maxima.
using Float4 = float __attribute__((vector_size(16)));

inline Float4 minimum(Float4 a, Float4 b) { return a < b ? a : b; }
inline Float4 maximum(Float4 a, Float4 b) { return a > b ? a : b; }

/// x, y, z in the first three places; the fourth means nothing.
struct Box {
    Float4 low, high;
};

inline Box empty_box() {
    constexpr float infinity = std::numeric_limits<float>::infinity();
    return {Float4{} + infinity, Float4{} - infinity};
}

inline Box box_union(const Box& a, const Box& b) {
    return {minimum(a.low, b.low), maximum(a.high, b.high)};
}

/// Half the surface, in double: a float would overflow for boxes of 1e19 and vanish for those of
/// 1e-23.
inline double half_area(const Box& box) {
    double x = double(box.high[0]) - box.low[0], y = double(box.high[1]) - box.low[1];
    double z = double(box.high[2]) - box.low[2];
    return x * y + (x + y) * z;
}

/// An integer below 2^30 as a float from 1 on. Its bits alone would be a denormal, which slows
/// arithmetic down tenfold.
inline float hide_integer(int i) { return std::bit_cast<float>(i + std::bit_cast<int>(1.f)); }
inline int hidden_integer(float f) { return std::bit_cast<int>(f) - std::bit_cast<int>(1.f); }

/// A primitive's box; its number and kind ride in the fourth places.
struct Reference {
    Box box;

    int primitive() const { return hidden_integer(box.low[3]); }
    int kind() const { return hidden_integer(box.high[3]); }
};

/// Half the centre of the box: of finite coordinates, differences of two of these cannot overflow.
inline Float4 half_centre(const Reference& reference) {
    return 0.25f * reference.box.low + 0.25f * reference.box.high;
}

/// The geometry kind of a primitive (enum GeometryKind).
inline int geometry_kind(const PrimitiveRecord& primitive) {
    return primitive.flags & PRIMITIVE_KIND_MASK;
}

/// Whether a primitive is no triangle without area: corners that coincide, or lie in line. The ray
/// test would hit the latter, since a ray's shear rounds them out of line, and the surface there
/// would have no normal (`extra` is 0 for the same triangles).
bool can_be_hit(const PrimitiveRecord& primitive);

/// The longest side of a primitive's own box.
float longest_side(const PrimitiveRecord& primitive);

/// Box and number of a primitive. The box is larger than the primitive's own by BOX_MARGIN of its
/// longest side, what rounding does to a hit (kernels/shared/intersect.h), but for triangles of no
/// longer a side than `side`.
Reference make_reference(const PrimitiveRecord& primitive, int number, float side);

} // namespace parhelion
