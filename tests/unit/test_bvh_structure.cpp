// What must hold for every tree: all primitives once, boxes that contain, leaves of one kind, a
// stack that suffices.
#include "host/bvh/bounds.h"
#include "host/numerics/shapes.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <string>

using namespace parhelion;
using namespace parhelion::rays;

namespace {

struct Bounds {
    Vector low{INFINITY, INFINITY, INFINITY}, high{-INFINITY, -INFINITY, -INFINITY};

    bool contains(const Bounds& inner) const {
        bool all = true;
        for (std::size_t a = 0; a < 3; a++)
            all = all && low[a] <= inner.low[a] && inner.high[a] <= high[a];
        return all;
    }
    void grow(const Vector& v) {
        for (std::size_t a = 0; a < 3; a++)
            low[a] = std::min(low[a], v[a]), high[a] = std::max(high[a], v[a]);
    }
};

/// A place of a leaf that holds nothing: not a number where a column could be a triangle, else
/// zero.
bool is_absent(const Leaf& leaf, std::size_t place) {
    const std::array<float, 9>& column = leaf.column[place];
    if (leaf.kind == geometry_triangle && leaf.lines * sizeof(BvhLine) == sizeof(BvhLeaf))
        return std::all_of(column.begin(), column.end(), [](float x) { return std::isnan(x); });
    return column == std::array<float, 9>{};
}

/// What the tree says of itself, gathered by going through all of it.
struct Survey {
    std::vector<int> seen; ///< how often each primitive stands in a leaf
    std::size_t nodes = 0, leaves = 0, lines = 0, used_places = 0;
    int depth = 0, stack_entries = 0;
    int loose_boxes = 0, wrong_kinds = 0, wrong_columns = 0, gaps = 0;
};

/// Points that the primitive contains, or nearly: corners; the extremes of a sphere along the axes;
/// points of a disk's rim.
Bounds inner_bounds(const PrimitiveRecord& p) {
    Bounds b;
    Vector a{p.ax, p.ay, p.az}, u{p.bx, p.by, p.bz}, v{p.cx, p.cy, p.cz};
    if (kind_of(p) == geometry_triangle)
        for (const Vector& corner : {a, u, v})
            b.grow(corner);
    if (kind_of(p) == geometry_sphere)
        for (std::size_t axis = 0; axis < 3; axis++)
            for (float side : {-p.extra, p.extra}) {
                Vector extreme = a;
                extreme[axis] += side;
                b.grow(extreme);
            }
    if (kind_of(p) == geometry_cylinder) {
        f64::vec3 axis = f64::v3(u[0], u[1], u[2]);
        f64::ShadingFrame frame = f64::frame_from_normal(f64::normalize3(axis));
        for (int i = 0; i < 128; i++) {
            double angle = 2 * M_PI / 64 * i;
            f64::vec3 rim = f64::scale3(f64::add3(f64::scale3(frame.s, std::cos(angle)),
                                                  f64::scale3(frame.t, std::sin(angle))),
                                        p.extra);
            Vector off{float(rim.x), float(rim.y), float(rim.z)};
            b.grow(add(i < 64 ? a : add(a, u), off));
        }
    }
    if (kind_of(p) == geometry_disk)
        for (int i = 0; i < 64; i++) {
            float angle = float(i) * .098174770f;
            b.grow(add(a, add(scaled(u, std::cos(angle)), scaled(v, std::sin(angle)))));
        }
    return b;
}

class Surveyor {
public:
    Surveyor(const Bvh& bvh, const Primitives& primitives) : bvh_(bvh), primitives_(primitives) {
        survey_.seen.assign(primitives.size(), 0);
    }

    Survey run(int root) {
        visit(root, 1, 0);
        return survey_;
    }

private:
    Bounds visit(int child, int depth, int waiting) {
        return child < 0 ? visit_leaf(child) : visit_node(child, depth, waiting);
    }

    Bounds visit_leaf(int child) {
        Leaf leaf = read_leaf(bvh_, child);
        survey_.leaves++;
        survey_.lines += std::size_t(leaf.lines);
        Bounds all;
        for (std::size_t k = 0; k < BVH_WIDTH; k++) {
            const std::array<float, 9>& column = leaf.column[k];
            if (leaf.primitive[k] < 0) {
                survey_.wrong_columns += !is_absent(leaf, k);
                continue;
            }
            survey_.gaps += k > 0 && leaf.primitive[k - 1] < 0;
            survey_.used_places++;
            const PrimitiveRecord& p = primitives_.at(std::size_t(leaf.primitive[k]));
            survey_.seen[std::size_t(leaf.primitive[k])]++;
            survey_.wrong_kinds += kind_of(p) != leaf.kind;
            survey_.wrong_columns += column != column_of(p);
            Bounds b = inner_bounds(p);
            all.grow(b.low);
            all.grow(b.high);
        }
        return all;
    }

    Bounds visit_node(int number, int depth, int waiting) {
        const BvhNode& node = bvh_.nodes.at(std::size_t(number));
        survey_.nodes++;
        survey_.depth = std::max(survey_.depth, depth);
        int children = 0;
        for (int k = 0; k < BVH_WIDTH; k++)
            children += node.bounds[0][k] <= node.bounds[1][k];
        waiting += std::max(0, children - 1);
        survey_.stack_entries = std::max(survey_.stack_entries, waiting);
        Bounds all;
        for (int k = 0; k < BVH_WIDTH; k++) {
            Bounds box{{node.bounds[0][k], node.bounds[2][k], node.bounds[4][k]},
                       {node.bounds[1][k], node.bounds[3][k], node.bounds[5][k]}};
            if (box.low[0] > box.high[0]) {
                survey_.gaps += !(box.low == Bounds().low && box.high == Bounds().high);
                continue;
            }
            survey_.gaps += k >= children;
            survey_.loose_boxes += !box.contains(visit(node.child[k], depth + 1, waiting));
            all.grow(box.low);
            all.grow(box.high);
        }
        return all;
    }

    const Bvh& bvh_;
    const Primitives& primitives_;
    Survey survey_;
};

Survey check_tree(const Primitives& primitives, int stack_limit = BVH_STACK) {
    Bvh bvh;
    BvhStatistics statistics;
    int root = bvh_append(bvh, indexed_geometry(primitives), &statistics, stack_limit);
    Survey survey = Surveyor(bvh, primitives).run(root);
    int misplaced = 0;
    for (std::size_t i = 0; i < primitives.size(); i++)
        misplaced += survey.seen[i] != int(can_be_hit(primitives[i]));
    CHECK(misplaced == 0);
    CHECK(survey.loose_boxes == 0);
    CHECK(survey.wrong_kinds == 0);
    CHECK(survey.wrong_columns == 0);
    CHECK(survey.gaps == 0);
    CHECK(survey.nodes == bvh.nodes.size());
    CHECK(survey.lines == bvh.leaves.size());
    CHECK(survey.nodes == statistics.node_count);
    CHECK(survey.leaves == statistics.leaf_count);
    CHECK(statistics.bytes == survey.nodes * sizeof(BvhNode) + survey.lines * sizeof(BvhLine));
    double places = double(16 * std::max<std::size_t>(survey.leaves, 1));
    CHECK(statistics.leaf_fill == Approx(double(survey.used_places) / places));
    CHECK(survey.depth == statistics.depth);
    CHECK(survey.stack_entries == statistics.stack_entries);
    CHECK(survey.stack_entries <= stack_limit);
    CHECK(std::isfinite(statistics.sah_cost));
    return survey;
}

Primitives flattened(Primitives primitives) {
    for (PrimitiveRecord& p : primitives)
        p.ax = p.bx = p.cx = p.ay = p.by = p.cy = .5f;
    return primitives;
}

Primitives magnified(Primitives primitives, float factor) {
    for (PrimitiveRecord& p : primitives)
        for (float* x : {&p.ax, &p.ay, &p.az, &p.bx, &p.by, &p.bz, &p.cx, &p.cy, &p.cz, &p.extra})
            *x *= factor;
    return primitives;
}

} // namespace

TEST_CASE("Every tree holds each primitive that can be hit once, in boxes that contain it",
          "[bvh]") {
    struct Case {
        const char* name;
        Primitives primitives;
    };
    const Case cases[] = {
        {"one", random_triangles(1, 1)},
        {"sixteen", random_triangles(16, 1)},
        {"seventeen", random_triangles(17, 1)},
        {"thousands", random_triangles(5000, .1f)},
        {"enough for several threads", random_triangles(100000, .01f)},
        {"three kinds in one place", random_mixture(3)},
        {"three kinds", random_mixture(5000)},
        {"all alike", repeated(random_triangles(1, 1), 40000)},
        {"all alike, three kinds", repeated(random_mixture(3), 1000)},
        {"one plane", grid(50, 1)},
        {"on a line", flattened(random_triangles(1000, 1))},
        {"points", magnified(random_triangles(1000, 1), 0)},
        {"spheres that are points", repeated({sphere({0, 0, 0}, 0)}, 1000)},
        {"as large as floats can be", magnified(random_mixture(1000), 1e38f)},
        {"as small as floats can be", magnified(random_mixture(1000), 1e-43f)},
        {"needles", needles(3000)},
    };
    for (const Case& c : cases) {
        CAPTURE(c.name);
        check_tree(c.primitives);
    }
}

TEST_CASE("Triangles without area are in no tree, however thin ones are", "[bvh]") {
    Vector a{0, 0, 0}, b{3, 6, -9}, c{1, 2, -3}, d{1, 2, std::nextafter(-3.f, 0.f)};
    for (const auto& [x, y, z] : {std::array{a, a, a}, {a, a, b}, {a, b, a}, {b, a, a}, {a, b, c}})
        CHECK(!can_be_hit(triangle(x, y, z)));
    CHECK(can_be_hit(triangle(a, b, d)));
    CHECK(can_be_hit(sphere(a, 0)));
}

TEST_CASE("Boxes are those of the triangles, but for ones much larger than most", "[bvh]") {
    Primitives small = grid(50, 1);
    Bvh of_small;
    bvh_append(of_small, indexed_geometry(small));
    float longest = 0;
    for (const PrimitiveRecord& p : small)
        longest = std::max(longest, longest_side(p));
    CHECK(of_small.side == longest);

    Primitives mixed = small;
    mixed.push_back(triangle({-1e5f, 0, 0}, {1e5f, 0, 0}, {0, 0, 2e5f}));
    Bvh of_mixed;
    bvh_append(of_mixed, indexed_geometry(mixed));
    CHECK(of_mixed.side >= longest);
    CHECK(of_mixed.side < 1024 * longest);
    auto room = [&](const PrimitiveRecord& p) {
        Reference r = make_reference(p, 0, of_mixed.side);
        return r.box.high[1] - std::max({p.ay, p.by, p.cy});
    };
    CHECK(room(small.front()) == 0);
    CHECK(room(mixed.back()) >= 2e5f * BOX_MARGIN);
    CHECK(room(sphere({0, 0, 0}, 1)) >= 1 + 2 * BOX_MARGIN);
}

TEST_CASE("A tree over a subset leaves the other primitives and the trees before it alone",
          "[bvh]") {
    Primitives primitives = random_mixture(3000);
    std::vector<int> odd;
    for (int i = 1; i < 3000; i += 2)
        odd.push_back(i);
    Bvh bvh;
    BvhStatistics statistics;
    int all_root = bvh_append(bvh, indexed_geometry(primitives));
    std::size_t nodes = bvh.nodes.size();
    int odd_root = bvh_append(bvh, indexed_geometry(primitives), odd, &statistics);
    CHECK(bvh.nodes.size() == nodes + statistics.node_count);
    Survey both[] = {Surveyor(bvh, primitives).run(all_root),
                     Surveyor(bvh, primitives).run(odd_root)};
    for (int i = 0; i < 3000; i++)
        REQUIRE((both[0].seen[i] == 1 && both[1].seen[i] == i % 2));
    CHECK(both[0].loose_boxes + both[0].wrong_kinds + both[1].loose_boxes + both[1].wrong_kinds ==
          0);
}

TEST_CASE("Leaves of a mesh are patches, in half the lines; what does not fit one is a leaf",
          "[bvh]") {
    auto lines_a_leaf = [](const Primitives& primitives) {
        Survey survey = check_tree(primitives);
        return double(survey.lines) / double(survey.leaves);
    };
    constexpr double patch = double(sizeof(BvhPatch)) / sizeof(BvhLine);
    constexpr double whole = double(sizeof(BvhLeaf)) / sizeof(BvhLine);
    CHECK(lines_a_leaf(grid(100, 0)) < patch + .3 * (whole - patch));
    CHECK(lines_a_leaf(subdivided_sphere(4, 1, {0, 0, 0})) < patch + .3 * (whole - patch));
    CHECK(lines_a_leaf(random_triangles(16, 1)) == whole);
    CHECK(lines_a_leaf(repeated(random_triangles(1, 1), 16)) == patch);
    CHECK(lines_a_leaf(random_mixture(3)) == Approx((patch + 2 * whole) / 3));
}

TEST_CASE("Numbers too far apart for a patch, or as high as there are, stay what they are",
          "[bvh]") {
    Primitives primitives(std::size_t{1} << 21, triangle({0, 0, 0}, {1, 0, 0}, {0, 1, 0}));
    IndexedGeometry geometry = indexed_geometry(primitives);
    int highest = int(primitives.size()) - 1, apart = 1 << BVH_PATCH_NUMBERS;
    struct Case {
        int first, second;
        bool patch;
    };
    for (const Case& c :
         {Case{0, apart - 1, true}, Case{0, apart, false}, Case{highest - 5, highest, true},
          Case{8191, apart, false}, Case{8192, apart, true}, Case{0, highest, false}}) {
        CAPTURE(c.first, c.second);
        Bvh bvh;
        int numbers[] = {c.second, c.first};
        Leaf leaf = read_leaf(bvh, bvh_append(bvh, geometry, numbers));
        CHECK((leaf.lines == sizeof(BvhPatch) / sizeof(BvhLine)) == c.patch);
        CHECK(leaf.primitive[0] == c.second);
        CHECK(leaf.primitive[1] == c.first);
        CHECK(leaf.primitive[2] == -1);
    }
}

TEST_CASE("A tree of nothing is a node of empty boxes", "[bvh]") {
    Bvh bvh;
    BvhStatistics statistics;
    int root = bvh_append(bvh, {}, &statistics);
    REQUIRE(root == 0);
    CHECK(statistics.node_count == 1);
    CHECK(statistics.leaf_count == 0);
    for (int k = 0; k < BVH_WIDTH; k++) {
        CHECK(bvh.nodes[0].bounds[0][k] == INFINITY);
        CHECK(bvh.nodes[0].bounds[1][k] == -INFINITY);
    }
    Random random(1);
    for (int i = 0; i < 100; i++)
        CHECK(walk(bvh, root, random_ray(random, i)).primitive == -1);
}

TEST_CASE("The stack the kernels have suffices for every tree", "[bvh]") {
    SECTION("geometric series") {
        for (float ratio : {1.01f, 1.1f, 2.f, 10.f})
            check_tree(repeated(geometric_series(ratio, 8000), 3));
    }
    SECTION("a tree over the limit is built again by halving") {
        Primitives primitives = geometric_series(1.1f, 1500);
        int unlimited = check_tree(primitives).stack_entries;
        int limited = check_tree(primitives, unlimited - 1).stack_entries;
        CHECK(limited < unlimited);
    }
    SECTION("no walk has more waiting than the statistics say") {
        Primitives primitives = random_triangles(3000, .3f);
        Bvh bvh;
        BvhStatistics statistics;
        int root = bvh_append(bvh, indexed_geometry(primitives), &statistics);
        Random random(7);
        std::size_t peak = 0;
        for (int i = 0; i < 1000; i++)
            walk(bvh, root, random_ray(random, i), &peak);
        CHECK(peak <= std::size_t(statistics.stack_entries));
        CHECK(peak > std::size_t(statistics.stack_entries) / 4);
    }
}
