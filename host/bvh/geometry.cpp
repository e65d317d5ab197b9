// Indexed geometry of single primitives.
#include "host/bvh/geometry.h"

namespace parhelion {

IndexedGeometry indexed_geometry(std::span<const PrimitiveRecord> primitives) {
    IndexedGeometry out;
    out.primitives.reserve(primitives.size());
    out.points.reserve(9 * primitives.size() + 4);
    for (const PrimitiveRecord& p : primitives) {
        int first = int(out.points.size());
        out.points.insert(out.points.end(), {p.ax, p.ay, p.az, p.bx, p.by, p.bz, p.cx, p.cy, p.cz});
        out.primitives.push_back({first, first + 3, first + 6, p.extra, p.flags, 0, -1});
    }
    out.points.insert(out.points.end(), 4, 0.f);
    return out;
}

} // namespace parhelion
