// Files with Burley's materials: indices, sides, sampling rates, and which lobes kernels have.
#include "host/flatten/device_scene.h"
#include "test_scene_tools.h"

#include <fmt/format.h>

#include <cmath>

using namespace parhelion;
using namespace parhelion::test;
using Catch::Matchers::Contains;

namespace {

std::string ball(const std::string& bsdf) { return "<shape type='sphere'>" + bsdf + "</shape>"; }
std::string principled(const std::string& inside) {
    return "<bsdf type='principled'>" + inside + "</bsdf>";
}
std::string number(const char* name, double value) {
    return fmt::format("<float name='{}' value='{}'/>", name, value);
}

PrincipledBsdf loaded(const std::string& inside) {
    return std::get<PrincipledBsdf>(load_body(ball(principled(inside))).materials.at(0).bsdf);
}

FeatureDecisions features_of(const std::string& inside) {
    return make_device_scene(load_body(ball(principled(inside)))).features;
}

} // namespace

TEST_CASE("Principled files: specular stands for an index", "[scene]") {
    CHECK(loaded("").eta == 1.5);
    CHECK(loaded(number("eta", 1.3)).eta == 1.3);
    // Its reflectance head-on is 0.08 times as much (Burley 2012, section 5.5).
    for (double specular : {0.1, 0.5, 1.0}) {
        double eta = loaded(number("specular", specular)).eta;
        CHECK(std::pow((eta - 1) / (eta + 1), 2) == Approx(0.08 * specular));
    }
    CHECK(loaded(number("specular", 0)).eta == 1.0);
    CHECK_THAT(refusal_of_body(ball(principled(number("eta", 1.3) + number("specular", 0.5)))),
               Contains("\"specular\"") && Contains("given together with \"eta\""));
}

TEST_CASE("Principled files: what goes through needs two indices", "[scene]") {
    auto eta = [](const std::string& index) {
        return loaded(number("spec_trans", 0.5) + index).eta;
    };
    CHECK(eta(number("eta", 1)) == 1.001); // as in Mitsuba 3
    CHECK(eta(number("eta", 0.9999)) == 1.001);
    CHECK(eta(number("eta", 1.002)) == 1.002);
    CHECK(eta(number("specular", 0)) == Approx(1.018053)); // of specular 0.001
    Scene scene = load_body(ball(principled(number("spec_trans", 0.5) + number("eta", 1))));
    REQUIRE(scene.notes.size() == 1);
    CHECK_THAT(scene.notes[0], Contains("\"eta\" is taken as 1.001"));
    CHECK(load_body(ball(principled(number("eta", 1)))).notes.empty());
}

TEST_CASE("Principled files: one through which nothing goes is opaque", "[scene]") {
    auto back = [](const std::string& bsdf) {
        return load_body(ball(bsdf)).shapes[0].material_back;
    };
    std::string opaque = principled(number("spec_trans", 0)),
                glass = principled(number("spec_trans", 0.1)),
                told = principled("<texture type='checkerboard' name='spec_trans'/>");
    CHECK(back(opaque) == no_material);
    CHECK(back(glass) == 0);
    CHECK(back(told) == 0);
    CHECK(back("<bsdf type='twosided'>" + opaque + "</bsdf>") == 0);
    for (const std::string& bsdf : {glass, told})
        CHECK_THAT(refusal_of_body(ball("<bsdf type='twosided'>" + bsdf + "</bsdf>")),
                   Contains("which light passes through"));
}

TEST_CASE("Principled files: sampling rates are read and noted", "[scene]") {
    for (const char* rate : {"diffuse_reflectance_sampling_rate", "main_specular_sampling_rate",
                             "clearcoat_sampling_rate"}) {
        Scene scene = load_body(ball(principled(number(rate, 2))));
        REQUIRE(scene.notes.size() == 1);
        CHECK_THAT(scene.notes[0], Contains(rate) && Contains("only the noise"));
        CHECK(load_body(ball(principled(number(rate, 1)))).notes.empty());
        CHECK_THAT(refusal_of_body(ball(principled(number(rate, -1)))), Contains(rate));
    }
}

TEST_CASE("Principled files: kernels have the lobes that some material has", "[scene]") {
    std::string sky = "<emitter type='constant'/>", board = "<texture type='checkerboard' name='";
    struct Lobe {
        const char* name;
        Feature feature;
    };
    for (Lobe lobe : {Lobe{"clearcoat", feature_clearcoat}, Lobe{"spec_trans", feature_spec_trans},
                      Lobe{"sheen", feature_sheen}, Lobe{"anisotropic", feature_anisotropy}}) {
        CAPTURE(lobe.name);
        CHECK_FALSE(features_of(number(lobe.name, 0)).has(lobe.feature));
        CHECK(features_of(number(lobe.name, 0.5)).has(lobe.feature));
        CHECK(features_of(board + lobe.name + "'/>").has(lobe.feature));
        CHECK_FALSE(features_of(number(lobe.name, 0.5)).has(feature_textured_numbers));
    }
    CHECK(features_of(board + "metallic'/>").has(feature_textured_numbers));
    CHECK_FALSE(features_of(board + "base_color'/>").has(feature_textured_numbers));
}
