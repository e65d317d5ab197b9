// The tree is the same bits whatever the number of threads, and each time it is built.
#include "host/numerics/shapes.h"

#include <catch2/catch.hpp>
#include <oneapi/tbb/global_control.h>

#include <cstring>

using namespace parhelion;
using namespace parhelion::rays;

namespace {

struct Tree {
    Bvh bvh;
    int root;
};

Tree build(const Primitives& primitives, std::size_t threads, int stack_limit) {
    tbb::global_control control(tbb::global_control::max_allowed_parallelism, threads);
    Tree tree;
    tree.root = bvh_append(tree.bvh, indexed_geometry(primitives), nullptr, stack_limit);
    return tree;
}

bool same_bits(const Tree& a, const Tree& b) {
    const auto& nodes = a.bvh.nodes;
    const auto& leaves = a.bvh.leaves;
    return a.root == b.root && nodes.size() == b.bvh.nodes.size() &&
           leaves.size() == b.bvh.leaves.size() &&
           std::memcmp(nodes.data(), b.bvh.nodes.data(), nodes.size() * sizeof(BvhNode)) == 0 &&
           std::memcmp(leaves.data(), b.bvh.leaves.data(), leaves.size() * sizeof(BvhLine)) == 0;
}

} // namespace

TEST_CASE("The tree does not depend on threads or time", "[bvh]") {
    Primitives mixture = random_mixture(120000);
    for (std::size_t i = 0; i < mixture.size(); i += 7)
        mixture[i].ax = i % 2 ? -0.f : 0.f; // equal, in other bits
    struct Case {
        const char* name;
        const Primitives& primitives;
        int stack_limit;
    };
    Primitives triangles = random_triangles(100000, .02f);
    for (const Case& c : {Case{"triangles", triangles, BVH_STACK},
                          Case{"mixture", mixture, BVH_STACK}, Case{"by halving", triangles, 0}}) {
        CAPTURE(c.name);
        Tree one = build(c.primitives, 1, c.stack_limit);
        for (std::size_t threads : {1, 2, 3, 8}) {
            CAPTURE(threads);
            CHECK(same_bits(one, build(c.primitives, threads, c.stack_limit)));
        }
    }
    CHECK_FALSE(same_bits(build(triangles, 1, BVH_STACK), build(triangles, 1, 0)));
}
