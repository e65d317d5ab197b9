// Features as a set: names and back, sums and differences, what the compiler is told; and a reason
// for each decision.
#include "host/error.h"
#include "host/feature_set.h"
#include "host/flatten/device_scene.h"
#include "tests/support/two_of_every.h"

#include <catch2/catch.hpp>
#include <fmt/format.h>

#include <stdexcept>

using namespace parhelion;
using namespace parhelion::test;

TEST_CASE("Feature set: every feature alone has its name, and its bit for the compiler") {
    for (int k = 0; k < feature_count; k++) {
        auto f = static_cast<Feature>(k);
        FeatureSet alone{f};
        REQUIRE(alone.names() == std::vector<std::string>{feature_name(f)});
        CHECK((FeatureSet::of(alone.names()) == alone));
        std::string bit = fmt::format("=0x{:x}ul", std::uint64_t{1} << (k % 64));
        std::string words = k < 64 ? "-DFEATURES_0" + bit + " -DFEATURES_1=0x0ul"
                                   : "-DFEATURES_0=0x0ul -DFEATURES_1" + bit;
        CHECK(alone.definitions() == words);
        for (int other = 0; other < feature_count; other++)
            CHECK(alone.has(static_cast<Feature>(other)) == (other == k));
    }
    CHECK(FeatureSet::all().names().size() == feature_count);
    CHECK(FeatureSet().empty());
    CHECK_THROWS_AS(FeatureSet::of({"bsdf_diffuse", "no_such_feature"}), InputError);
}

TEST_CASE("Feature set: of either, of both, and of one alone") {
    FeatureSet a{feature_ggx, feature_aovs}, b{feature_ggx, feature_emission};
    CHECK(((a | b) == FeatureSet{feature_ggx, feature_aovs, feature_emission}));
    CHECK(((a & b) == FeatureSet{feature_ggx}));
    CHECK(((a - b) == FeatureSet{feature_aovs}));
    a.set(feature_ggx, false);
    CHECK((a == FeatureSet{feature_aovs}));
}

TEST_CASE("Feature decisions: each is made once, and says what was found") {
    FeatureDecisions decisions;
    decisions.decide(feature_aovs, true, "2 of 2 layers");
    CHECK(decisions.has(feature_aovs));
    CHECK_THROWS_AS(decisions.decide(feature_aovs, false, "none"), std::logic_error);
    Scene nothing;
    for (const Scene& scene : {two_of_every(), nothing}) {
        FeatureDecisions of_scene = make_device_scene(scene).features;
        for (int k = 0; k < feature_count; k++) {
            CAPTURE(feature_name(static_cast<Feature>(k)));
            CHECK_FALSE(of_scene.why(static_cast<Feature>(k)).empty());
        }
    }
    auto why = make_device_scene(two_of_every()).features.reasons();
    CHECK(why.at("shape_disk") != why.at("shape_triangle"));
    CHECK(make_device_scene(nothing).features.reasons().at("several_lights") == "0 lights");
    CHECK(make_device_scene(nothing).features.why(feature_next_event) ==
          "0 lights, 0 of which rays can meet, paths of any length, lights are sampled");
    // Hidden from a view of normals by the camera's tree alone.
    nothing.integrator.hide_emitters = true;
    CHECK(make_device_scene(nothing).features.why(feature_hide_emitters) == "asked for");
    nothing.integrator.kind = IntegratorKind::normals;
    CHECK(make_device_scene(nothing).features.why(feature_hide_emitters) ==
          "no light transport is asked for");
}

TEST_CASE("Feature decisions: what is off because of something else says so") {
    Scene scene = two_of_every();
    auto why = [&](Feature f) { return make_device_scene(scene).features.why(f); };
    auto begins = [](const std::string& text, const char* with) { return text.starts_with(with); };
    CHECK(begins(why(feature_consistent_normals), "some smooth shapes, shading normals are"));
    scene.integrator.max_depth = 1;
    CHECK(begins(why(feature_consistent_normals), "some smooth shapes, no surface is lit ("));
    CHECK(why(feature_light_tree).find("paths of at most 1 edge,") != std::string::npos);
    scene.integrator.kind = IntegratorKind::depth;
    CHECK(why(feature_light_tree).find("no light transport is asked for") != std::string::npos);
    scene = two_of_every();
    scene.materials = {{"", {}, NullBsdf{}}, {"", {}, DiffuseBsdf{}}};
    for (Shape& shape : scene.shapes)
        shape.material_front = shape.material_back = 0;
    CHECK(why(feature_straight_through) == "1 of 2 materials let rays go straight on");
    scene.integrator.kind = IntegratorKind::direct;
    CHECK(begins(why(feature_straight_through), "1 of 2 materials let rays go straight on, which"));
    scene.shapes.clear();
    scene.emitters = {PointEmitter{}};
    CHECK(begins(why(feature_emission), "1 light, 0 of which rays can meet"));
}

TEST_CASE("Feature decisions: soft shading normals are for matte materials") {
    Scene scene = two_of_every();
    scene.integrator.shading_normals = ShadingNormals::soft;
    for (const Bsdf& bsdf :
         {Bsdf(DiffuseBsdf{}), Bsdf(RoughDiffuseBsdf{}), Bsdf(ConductorBsdf{})}) {
        scene.materials = {{"", {}, bsdf}};
        for (Shape& shape : scene.shapes)
            shape.material_front = shape.material_back = 0;
        bool metal = std::holds_alternative<ConductorBsdf>(bsdf);
        CHECK(make_device_scene(scene).features.has(feature_soft_terminator) == !metal);
        CHECK(make_device_scene(scene).features.has(feature_consistent_normals));
    }
}
