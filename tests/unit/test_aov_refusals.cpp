// What a scene cannot ask of the film beside its picture, by the line that refuses it.
#include "host/flatten/aov_plan.h"

#include <catch2/catch.hpp>

using namespace parhelion;

namespace {

/// What the AOVs, "name:kind" each, are refused with; empty: they are not.
std::string refusal(const std::vector<AovRequest>& aovs, int samples = 16) {
    Scene scene;
    scene.sampler.samples_per_pixel = samples;
    scene.integrator.aovs = aovs;
    try {
        plan_aovs(scene);
        return "";
    } catch (const InputError& error) {
        return error.what();
    }
}

const SourceLocation first{"scene.xml", 3}, second{"scene.xml", 7};

} // namespace

TEST_CASE("AOVs: no kind and no name twice", "[aov]") {
    CHECK(refusal({{"a", "depth", first}, {"b", "uv", second}}).empty());
    CHECK(refusal({{"a", "variance", first}, {"b", "samples", second}}).empty());
    struct Twice {
        AovRequest first, second;
    };
    const Twice cases[] = {{{"a", "depth", first}, {"a", "uv", second}},
                           {{"a", "depth", first}, {"b", "depth", second}},
                           {{"a", "variance", first}, {"b", "variance", second}},
                           {{"a", "variance", first}, {"a", "samples", second}},
                           // What the film tells and what paths tell stand side by side.
                           {{"a", "depth", first}, {"a", "samples", second}},
                           {{"a", "variance", first}, {"a", "depth", second}}};
    for (const Twice& twice : cases)
        CHECK(refusal({twice.first, twice.second}) == "scene.xml:7: AOV '" + twice.second.name +
                                                          "' (" + twice.second.kind +
                                                          ") is asked for twice");
    // Kinds of either are counted from 0 each: the same number is no other's kind.
    for (const AovKindInfo& of_path : aov_kinds)
        for (const AovKindInfo& of_film : film_aov_kinds)
            CHECK(refusal({{"a", std::string(of_path.name), first},
                           {"b", std::string(of_film.name), second}})
                      .empty());
}

TEST_CASE("AOVs: one sample has no variance", "[aov]") {
    CHECK(refusal({{"v", "variance", second}}, 1) ==
          "scene.xml:7: AOV 'variance' needs at least 2 samples per pixel");
    CHECK(refusal({{"v", "variance", second}}, 2).empty());
    CHECK(refusal({{"n", "samples", second}, {"d", "depth", first}}, 1).empty());
}

TEST_CASE("AOVs: what there is none of, and what there are", "[aov]") {
    CHECK(refusal({{"a", "dept", second}}) ==
          "scene.xml:7: there is no AOV 'dept'; there are albedo, sh_normal, geo_normal, position, "
          "uv, depth, shape_index, prim_index, variance, samples");
}
