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
    // Hidden from a view of normals by the camera's tree alone.
    nothing.integrator.hide_emitters = true;
    CHECK(make_device_scene(nothing).features.why(feature_hide_emitters) == "asked for");
    nothing.integrator.kind = IntegratorKind::normals;
    CHECK(make_device_scene(nothing).features.why(feature_hide_emitters) ==
          "no light transport is asked for");
}
