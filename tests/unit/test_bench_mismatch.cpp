// What the traversal benchmark calls a tie and what a mistake, and whose.
#include "benchmarks/native/mismatch.h"

#include <catch2/catch.hpp>

#include <vector>

using namespace parhelion;
using namespace parhelion::bench;

namespace {

PrimitiveRecord triangle(float z, float ax, float ay, float bx, float by, float cx, float cy) {
    PrimitiveRecord p{};
    p.ax = ax, p.ay = ay, p.bx = bx, p.by = by, p.cx = cx, p.cy = cy;
    p.az = p.bz = p.cz = z;
    return p;
}

/// A square at z = 1 cut along its diagonal (0 below it, 1 above), a large triangle at z = 2.
const std::vector<PrimitiveRecord> primitives{
    triangle(1, 0, 0, 1, 0, 1, 1), triangle(1, 0, 0, 1, 1, 0, 1), triangle(2, 0, 0, 4, 0, 0, 4)};
const Ray below{{0.7f, 0.2f, 0}, {0, 0, 1}}, on_diagonal{{0.5f, 0.5f, 0}, {0, 0, 1}},
    outside{{3, 3, 0}, {0, 0, 1}};

enum Verdict { agree, tie, ours_wrong, theirs_wrong };

Verdict judge(const Ray& ray, int ours, int theirs, bool any_hit) {
    Mismatches m = count_mismatches(primitives, std::vector{ray}, std::vector{Hit{1, 0, 0, ours}},
                                    std::vector{Hit{1, 0, 0, theirs}}, any_hit);
    CHECK(m.differ == m.ties + m.ours_wrong + m.theirs_wrong);
    return m.differ == 0 ? agree : m.ties ? tie : m.ours_wrong ? ours_wrong : theirs_wrong;
}

} // namespace

TEST_CASE("The traversal benchmark tells ties from mistakes: closest hit", "[bench]") {
    CHECK(judge(below, 0, 0, false) == agree);
    CHECK(judge(on_diagonal, 0, 1, false) == tie);
    CHECK(judge(below, 2, 0, false) == ours_wrong); // behind it
    CHECK(judge(below, 0, 2, false) == theirs_wrong);
    CHECK(judge(below, -1, 0, false) == ours_wrong);
    CHECK(judge(below, 0, -1, false) == theirs_wrong);
    CHECK(judge(below, 1, 0, false) == ours_wrong); // in its plane, but not met
    CHECK(judge(below, 0, 1, false) == theirs_wrong);
}

TEST_CASE("The traversal benchmark tells ties from mistakes: any hit", "[bench]") {
    CHECK(judge(below, 0, 0, true) == agree);
    CHECK(judge(below, -1, 0, true) == ours_wrong);
    CHECK(judge(below, 0, -1, true) == theirs_wrong);
    CHECK(judge(outside, 0, -1, true) == ours_wrong);
    Ray ends_on_it = below;
    ends_on_it.t_max = 1;
    CHECK(judge(ends_on_it, -1, 0, true) == tie);
    Ray ends_before = below;
    ends_before.t_max = 0.99f;
    CHECK(judge(ends_before, 0, -1, true) == ours_wrong);
    Ray leaves_it = below;
    leaves_it.excluded = 0;
    leaves_it.t_max = 1.5f;
    CHECK(judge(leaves_it, 0, -1, true) == ours_wrong);
}
