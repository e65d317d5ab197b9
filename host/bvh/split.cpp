// Divisions whose order does not depend on the threads: long ranges are worked on in pieces of one
// size, and what is known of the pieces is put together in their order.
#include "host/bvh/split.h"

#include "host/bvh/bins.h"
#include "host/parallel.h"

#include <algorithm>
#include <vector>

namespace parhelion {
namespace {

constexpr std::size_t piece_size = 1 << 13; // references in a task

std::size_t piece_count(std::size_t references) {
    return (references + piece_size - 1) / piece_size;
}

/// body(piece, first reference, references) for all pieces of a range.
template<class Body>
void for_pieces(std::size_t references, const Body& body) {
    parallel_for(piece_count(references), [&](std::size_t piece) {
        std::size_t begin = piece * piece_size;
        body(piece, begin, std::min(piece_size, references - begin));
    });
}

RangeBounds empty_bounds() { return {empty_box(), empty_box()}; }

Box centre_union(const Box& box, Float4 centre) {
    return {minimum(box.low, centre), maximum(box.high, centre)};
}

RangeBounds piece_bounds(std::span<const Reference> piece) {
    RangeBounds bounds = empty_bounds();
    for (const Reference& r : piece) {
        bounds.box = box_union(bounds.box, r.box);
        bounds.centres = centre_union(bounds.centres, half_centre(r));
    }
    return bounds;
}

/// Where the two parts of a piece go.
struct Targets {
    Reference *first, *second;
};

/// Writes the parts of a piece in their order; returns the boxes of their centres.
std::array<Box, 2> distribute(std::span<const Reference> piece, const BinGrid& grid,
                              const BinPlane& plane, Targets targets) {
    std::array<Box, 2> centres{empty_box(), empty_box()};
    int axis = plane.axis;
    float origin = grid.origin[axis], scale = grid.scale[axis];
    for (const Reference& r : piece) {
        Float4 centre = half_centre(r);
        float position = (centre[axis] - origin) * scale;
        bool second = int(position < last_position ? position : last_position) > plane.last_bin;
        Box& box = centres[second];
        box = centre_union(box, centre);
        // No branch: which part it is cannot be foreseen.
        *(second ? targets.second : targets.first) = r;
        targets.first += !second;
        targets.second += second;
    }
    return centres;
}

Division split_serial(std::span<const Reference> range, const BinGrid& grid,
                      std::span<Reference> target) {
    Bins bins = empty_bins();
    fill(bins, range, grid);
    BinPlane plane = best_plane(bins);
    if (plane.axis < 0) return {};
    auto first_count = std::size_t(first_part(bins, plane));
    std::array<Box, 2> boxes = part_boxes(bins, plane);
    std::array<Box, 2> centres =
        distribute(range, grid, plane, {target.data(), target.data() + first_count});
    return {first_count, {RangeBounds{boxes[0], centres[0]}, RangeBounds{boxes[1], centres[1]}}};
}

Bins join_all(const std::vector<Bins>& pieces) {
    Bins all = pieces[0];
    for (std::size_t i = 1; i < pieces.size(); i++)
        join(all, pieces[i]);
    return all;
}

Division split_parallel(std::span<const Reference> range, const BinGrid& grid,
                        std::span<Reference> target) {
    std::vector<Bins> bins(piece_count(range.size()));
    for_pieces(range.size(), [&](std::size_t piece, std::size_t begin, std::size_t count) {
        bins[piece] = empty_bins();
        fill(bins[piece], range.subspan(begin, count), grid);
    });
    Bins all = join_all(bins);
    BinPlane plane = best_plane(all);
    if (plane.axis < 0) return {};
    auto first_count = std::size_t(first_part(all, plane));
    std::vector<std::size_t> first_before(bins.size() + 1, 0);
    for (std::size_t i = 0; i < bins.size(); i++)
        first_before[i + 1] = first_before[i] + std::size_t(first_part(bins[i], plane));
    std::vector<std::array<Box, 2>> centres(bins.size());
    for_pieces(range.size(), [&](std::size_t piece, std::size_t begin, std::size_t count) {
        std::size_t first = first_before[piece], second = first_count + begin - first;
        centres[piece] = distribute(range.subspan(begin, count), grid, plane,
                                    {target.data() + first, target.data() + second});
    });
    std::array<Box, 2> boxes = part_boxes(all, plane), ends = centres[0];
    for (const std::array<Box, 2>& piece : centres)
        ends = {box_union(ends[0], piece[0]), box_union(ends[1], piece[1])};
    return {first_count, {RangeBounds{boxes[0], ends[0]}, RangeBounds{boxes[1], ends[1]}}};
}

Division division_at(std::span<const Reference> range, std::size_t first_count) {
    return {first_count,
            {range_bounds(range.first(first_count)), range_bounds(range.subspan(first_count))}};
}

} // namespace

RangeBounds range_bounds(std::span<const Reference> range) {
    if (range.size() <= parallel_range) return piece_bounds(range);
    std::vector<RangeBounds> pieces(piece_count(range.size()));
    for_pieces(range.size(), [&](std::size_t piece, std::size_t begin, std::size_t count) {
        pieces[piece] = piece_bounds(range.subspan(begin, count));
    });
    RangeBounds bounds = empty_bounds();
    for (const RangeBounds& piece : pieces)
        bounds = {box_union(bounds.box, piece.box), box_union(bounds.centres, piece.centres)};
    return bounds;
}

bool one_kind(std::span<const Reference> range) {
    int kind = range.front().kind();
    return std::all_of(range.begin(), range.end(),
                       [kind](const Reference& r) { return r.kind() == kind; });
}

Division split_by_surface_area(std::span<const Reference> range, const RangeBounds& bounds,
                               std::span<Reference> target) {
    BinGrid grid(bounds.centres);
    return range.size() > parallel_range ? split_parallel(range, grid, target)
                                         : split_serial(range, grid, target);
}

Division split_in_half(std::span<Reference> range, const RangeBounds& bounds) {
    Float4 extent = bounds.centres.high - bounds.centres.low;
    int axis = extent[0] >= extent[1] ? (extent[0] >= extent[2] ? 0 : 2)
                                      : (extent[1] >= extent[2] ? 1 : 2);
    auto before = [axis](const Reference& a, const Reference& b) {
        float x = half_centre(a)[axis], y = half_centre(b)[axis];
        return x < y || (x == y && a.primitive() < b.primitive());
    };
    std::size_t half = range.size() / 2;
    std::nth_element(range.begin(), range.begin() + std::ptrdiff_t(half), range.end(), before);
    return division_at(range, half);
}

Division split_by_kind(std::span<Reference> range) {
    auto lower = [](const Reference& a, const Reference& b) { return a.kind() < b.kind(); };
    int lowest = std::min_element(range.begin(), range.end(), lower)->kind();
    auto middle = std::partition(range.begin(), range.end(),
                                 [lowest](const Reference& r) { return r.kind() == lowest; });
    return division_at(range, std::size_t(middle - range.begin()));
}

} // namespace parhelion
