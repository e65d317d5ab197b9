// The primitives of a scene as it stores them: points, and what joins them.
#pragma once

#include "host/large_vector.h"
#include "kernels/shared/types.h"

#include <cstddef>
#include <span>
#include <vector>

namespace parhelion {

/// Numbers of primitives and shapes are rows of these.
struct IndexedGeometry {
    LargeVector<IndexedPrimitiveRecord> primitives; ///< those of a shape one behind the other
    LargeVector<float> points; ///< POINT_WORDS each, and as many and one more behind them
    std::vector<ShapeRecord> shapes;

    /// One by itself.
    PrimitiveRecord primitive(int number) const;
    int shape_of(int number) const;
    /// Its number among those of its shape.
    int index_in_shape(int number) const;
};

/// The same of primitives that share no points and have no shapes.
IndexedGeometry indexed_geometry(std::span<const PrimitiveRecord> primitives);

inline PrimitiveRecord IndexedGeometry::primitive(int number) const {
    const IndexedPrimitiveRecord& p = primitives[std::size_t(number)];
    const float *a = &points[std::size_t(p.a)], *b = &points[std::size_t(p.b)],
                *c = &points[std::size_t(p.c)];
    return {
        a[0], a[1], a[2], b[0], b[1], b[2], c[0], c[1], c[2], p.extra, PRIMITIVE_FLAGS(p.shape)};
}

inline int IndexedGeometry::shape_of(int number) const {
    return PRIMITIVE_SHAPE(primitives[std::size_t(number)].shape);
}

inline int IndexedGeometry::index_in_shape(int number) const {
    return number - shapes[std::size_t(shape_of(number))].first_primitive;
}

} // namespace parhelion
