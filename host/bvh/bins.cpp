// References counted and enclosed by bins along the three axes, and the cheapest plane between
// bins.
#include "host/bvh/bins.h"

#include "kernels/shared/types.h"

#include <algorithm>
#include <cstdlib>
#include <numeric>

namespace parhelion {
namespace {

/// Leaves are tested 16 primitives at a time.
int blocks_of(int count) { return (count + BVH_WIDTH - 1) / BVH_WIDTH; }

BinPlane best_plane_of(const std::array<Box, bin_count>& boxes,
                       const std::array<int, bin_count>& counts, int axis) {
    std::array<double, bin_count> above_cost;
    Box box = empty_box();
    int total = 0;
    for (int i = bin_count - 1; i > 0; i--) {
        if (counts[i] > 0) { // else the same division as the plane before
            box = box_union(box, boxes[i]);
            total += counts[i];
            above_cost[i] = half_area(box) * blocks_of(total);
        } else {
            above_cost[i] = i + 1 < bin_count ? above_cost[i + 1] : 0;
        }
    }
    total += counts[0];
    BinPlane best;
    box = empty_box();
    int below = 0;
    for (int i = 0; i < bin_count - 1; i++) {
        if (counts[i] == 0) continue;
        box = box_union(box, boxes[i]);
        below += counts[i];
        if (below == total) break;
        double cost = half_area(box) * blocks_of(below) + above_cost[i + 1];
        int imbalance = std::abs(total - 2 * below);
        if (cost < best.cost || (cost == best.cost && imbalance < best.imbalance))
            best = {axis, i, cost, imbalance};
    }
    return best;
}

} // namespace

Bins empty_bins() {
    Bins bins;
    for (int axis = 0; axis < 3; axis++) {
        bins.boxes[axis].fill(empty_box());
        bins.counts[axis].fill(0);
    }
    return bins;
}

void fill(Bins& bins, std::span<const Reference> range, const BinGrid& grid) {
    auto add = [&](const Reference& r) {
        Int4 bin = grid.bin_of(r);
#pragma GCC unroll 3
        for (int axis = 0; axis < 3; axis++) {
            Box& box = bins.boxes[axis][bin[axis]];
            box = box_union(box, r.box);
            bins.counts[axis][bin[axis]]++;
        }
    };
    // Neighbours tend to fall into one bin, and would wait for each other there.
    constexpr std::size_t streams = 4;
    std::size_t length = range.size() / streams;
    for (std::size_t i = 0; i < length; i++)
        for (std::size_t stream = 0; stream < streams; stream++)
            add(range[stream * length + i]);
    for (const Reference& r : range.subspan(streams * length))
        add(r);
}

void join(Bins& bins, const Bins& later) {
    for (int axis = 0; axis < 3; axis++)
        for (int i = 0; i < bin_count; i++) {
            bins.boxes[axis][i] = box_union(bins.boxes[axis][i], later.boxes[axis][i]);
            bins.counts[axis][i] += later.counts[axis][i];
        }
}

BinPlane best_plane(const Bins& bins) {
    BinPlane best;
    for (int axis = 0; axis < 3; axis++) {
        BinPlane plane = best_plane_of(bins.boxes[axis], bins.counts[axis], axis);
        if (plane.cost < best.cost || (plane.cost == best.cost && plane.imbalance < best.imbalance))
            best = plane;
    }
    return best;
}

int first_part(const Bins& bins, const BinPlane& plane) {
    auto begin = bins.counts[plane.axis].begin();
    return std::accumulate(begin, begin + plane.last_bin + 1, 0);
}

std::array<Box, 2> part_boxes(const Bins& bins, const BinPlane& plane) {
    std::array<Box, 2> boxes{empty_box(), empty_box()};
    for (int i = 0; i < bin_count; i++) {
        Box& box = boxes[i > plane.last_bin];
        box = box_union(box, bins.boxes[plane.axis][i]);
    }
    return boxes;
}

} // namespace parhelion
