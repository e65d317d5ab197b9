// Binned SAH splits, medians, and partitions whose order does not depend on the threads.
#include "host/bvh/split.h"

#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/parallel_reduce.h>

#include <algorithm>
#include <array>
#include <vector>

namespace parhelion {
namespace {

constexpr int bin_count = 32;
constexpr std::size_t grain_size = 1 << 13; // references in a task

using Int4 = int __attribute__((vector_size(16)));
using Blocks = tbb::blocked_range<std::size_t>;

/// Folds fold(T, reference) over the range, joining neighbouring parts with join(T, T) in their
/// order. Minima, maxima and counts do not depend on how the range was cut up (and of 0 and -0 the
/// last one wins, however it was cut).
template<class T, class Fold, class Join>
T reduce(std::span<const Reference> range, const T& start, const Fold& fold, const Join& join) {
    auto serial = [&](const Blocks& block, T value) {
        for (std::size_t i = block.begin(); i < block.end(); i++)
            fold(value, range[i]);
        return value;
    };
    Blocks all(0, range.size(), grain_size);
    return range.size() > parallel_range ? tbb::parallel_reduce(all, start, serial, join)
                                         : serial(all, start);
}

Box centre_box(std::span<const Reference> range) {
    auto fold = [](Box& box, const Reference& r) {
        Float4 centre = half_centre(r);
        box = {minimum(box.low, centre), maximum(box.high, centre)};
    };
    return reduce(range, empty_box(), fold, box_union);
}

/// Maps centres to bins along all axes at once.
struct Grid {
    Float4 origin, scale;

    /// Where the scale is infinite (no extent, or one too small to divide by) everything falls into
    /// the last bin.
    Int4 bin_of(const Reference& reference) const {
        Float4 position = (half_centre(reference) - origin) * scale;
        return __builtin_convertvector(minimum(position, Float4{} + (bin_count - 1)), Int4);
    }
};

struct Bins {
    std::array<std::array<Box, bin_count>, 3> boxes;
    std::array<std::array<int, bin_count>, 3> counts;
};

Bins empty_bins() {
    Bins bins;
    for (int axis = 0; axis < 3; axis++) {
        bins.boxes[axis].fill(empty_box());
        bins.counts[axis].fill(0);
    }
    return bins;
}

Bins fill_bins(std::span<const Reference> range, const Grid& grid) {
    auto fold = [&grid](Bins& bins, const Reference& r) {
        Int4 bin = grid.bin_of(r);
        for (int axis = 0; axis < 3; axis++) {
            Box& box = bins.boxes[axis][bin[axis]];
            box = box_union(box, r.box);
            bins.counts[axis][bin[axis]]++;
        }
    };
    auto join = [](Bins a, const Bins& b) {
        for (int axis = 0; axis < 3; axis++)
            for (int i = 0; i < bin_count; i++) {
                a.boxes[axis][i] = box_union(a.boxes[axis][i], b.boxes[axis][i]);
                a.counts[axis][i] += b.counts[axis][i];
            }
        return a;
    };
    return reduce(range, empty_bins(), fold, join);
}

/// References in bins up to `last_bin` along `axis` go to the first part.
struct Plane {
    int axis = -1, last_bin = 0;
    double cost = std::numeric_limits<double>::infinity();
    int imbalance = 0;
};

/// Leaves are tested 16 primitives at a time.
int blocks_of(int count) { return (count + BVH_WIDTH - 1) / BVH_WIDTH; }

/// The cheapest plane of one axis; of equally cheap ones the most balanced.
Plane best_plane(const std::array<Box, bin_count>& boxes, const std::array<int, bin_count>& counts,
                 int axis) {
    std::array<double, bin_count> above_cost;
    Box box = empty_box();
    int total = 0;
    for (int i = bin_count - 1; i > 0; i--) {
        box = box_union(box, boxes[i]);
        total += counts[i];
        above_cost[i] = total ? half_area(box) * blocks_of(total) : 0;
    }
    total += counts[0];
    Plane best;
    box = empty_box();
    int below = 0;
    for (int i = 0; i < bin_count - 1; i++) {
        if (counts[i] == 0) continue; // the same division as the plane before
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

Plane best_plane(const Bins& bins) {
    Plane best;
    for (int axis = 0; axis < 3; axis++) {
        Plane plane = best_plane(bins.boxes[axis], bins.counts[axis], axis);
        if (plane.cost < best.cost || (plane.cost == best.cost && plane.imbalance < best.imbalance))
            best = plane;
    }
    return best;
}

/// Keeps the order within both parts: each task knows from the counts of those before it where its
/// references go.
template<class Test>
std::size_t parallel_partition(std::span<Reference> range, std::span<Reference> scratch,
                               const Test& first_part) {
    std::size_t tasks = (range.size() + grain_size - 1) / grain_size;
    std::vector<std::size_t> first_before(tasks + 1, 0);
    auto for_tasks = [&](auto&& body) {
        tbb::parallel_for(std::size_t{0}, tasks, [&](std::size_t task) {
            std::size_t begin = task * grain_size;
            body(task, begin, std::min(begin + grain_size, range.size()));
        });
    };
    for_tasks([&](std::size_t task, std::size_t begin, std::size_t end) {
        first_before[task + 1] =
            std::size_t(std::count_if(&range[begin], &range[begin] + (end - begin), first_part));
    });
    for (std::size_t task = 0; task < tasks; task++)
        first_before[task + 1] += first_before[task];
    for_tasks([&](std::size_t task, std::size_t begin, std::size_t end) {
        std::size_t first = first_before[task], second = first_before[tasks] + begin - first;
        for (std::size_t i = begin; i < end; i++)
            scratch[first_part(range[i]) ? first++ : second++] = range[i];
    });
    for_tasks([&](std::size_t, std::size_t begin, std::size_t end) {
        std::copy(&scratch[begin], &scratch[begin] + (end - begin), &range[begin]);
    });
    return first_before[tasks];
}

template<class Test>
std::size_t partition_serial(std::span<Reference> range, const Test& first_part) {
    return std::size_t(std::partition(range.begin(), range.end(), first_part) - range.begin());
}

} // namespace

Box range_box(std::span<const Reference> range) {
    return reduce(
        range, empty_box(), [](Box& box, const Reference& r) { box = box_union(box, r.box); },
        box_union);
}

bool one_kind(std::span<const Reference> range) {
    int kind = range.front().kind();
    return std::all_of(range.begin(), range.end(),
                       [kind](const Reference& r) { return r.kind() == kind; });
}

std::size_t split_by_surface_area(std::span<Reference> range, std::span<Reference> scratch) {
    Box centres = centre_box(range);
    Grid grid{centres.low, bin_count / (centres.high - centres.low)};
    Plane plane = best_plane(fill_bins(range, grid));
    if (plane.axis < 0) return split_in_half(range);
    auto first_part = [&](const Reference& r) {
        return grid.bin_of(r)[plane.axis] <= plane.last_bin;
    };
    return range.size() > parallel_range ? parallel_partition(range, scratch, first_part)
                                         : partition_serial(range, first_part);
}

std::size_t split_in_half(std::span<Reference> range) {
    Box centres = centre_box(range);
    Float4 extent = centres.high - centres.low;
    int axis = extent[0] >= extent[1] ? (extent[0] >= extent[2] ? 0 : 2)
                                      : (extent[1] >= extent[2] ? 1 : 2);
    auto before = [axis](const Reference& a, const Reference& b) {
        float x = half_centre(a)[axis], y = half_centre(b)[axis];
        return x < y || (x == y && a.primitive() < b.primitive());
    };
    std::size_t half = range.size() / 2;
    std::nth_element(range.begin(), range.begin() + std::ptrdiff_t(half), range.end(), before);
    return half;
}

std::size_t split_by_kind(std::span<Reference> range) {
    auto lower = [](const Reference& a, const Reference& b) { return a.kind() < b.kind(); };
    int lowest = std::min_element(range.begin(), range.end(), lower)->kind();
    return partition_serial(range, [lowest](const Reference& r) { return r.kind() == lowest; });
}

} // namespace parhelion
