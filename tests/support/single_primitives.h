// The primitives of a scene, each by itself.
#pragma once

#include "host/bvh/geometry.h"

#include <vector>

namespace parhelion::test {

inline std::vector<PrimitiveRecord> single_primitives(const IndexedGeometry& geometry) {
    std::vector<PrimitiveRecord> primitives;
    for (std::size_t i = 0; i < geometry.primitives.size(); i++)
        primitives.push_back(geometry.primitive(int(i)));
    return primitives;
}

} // namespace parhelion::test
