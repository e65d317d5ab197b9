// phong and ward as files of Mitsuba 0.x have them: names, what is missing, reflectances of more
// than 1 together, textures; and what a sheet of them shows of an even sky.
#include "host/flatten/device_scene.h"
#include "tests/support/example_textures.h"
#include "tests/support/host_render.h"
#include "tests/support/image_files.h"
#include "tests/support/sheet.h"
#include "tests/unit/test_scene_tools.h"

#include <glm/geometric.hpp>

#include <cmath>

using namespace parhelion;
using namespace parhelion::test;
using Catch::Contains;

namespace {

Scene ball_of(const std::string& bsdf, const std::string& version = "0.6.0") {
    return load_body("<shape type='sphere'>" + bsdf + "</shape>", version);
}

template<class B>
B only_bsdf(const Scene& scene) {
    return std::get<B>(scene.materials.at(0).bsdf);
}

struct Reflectances {
    Rgb diffuse, specular;
};

/// As the device gets them.
Reflectances packed(const Scene& scene) {
    const MaterialRecord m = make_device_scene(scene).materials.at(0);
    return {{m.r, m.g, m.b}, {m.tr, m.tg, m.tb}};
}

bool near(const Rgb& found, const Rgb& expected) {
    return glm::length(found - expected) < 1e-6 * glm::length(expected);
}

/// Under a sky of 1, what is seen of it.
Scene sheet_of(const Bsdf& bsdf) {
    Scene scene = sheet(0, no_material, {{"", {}, bsdf}});
    scene.emitters.push_back(ConstantEmitter{Rgb(1)});
    scene.camera.fov_degrees = 0.01; // along the normal
    scene.sampler.samples_per_pixel = 256;
    return scene;
}

double seen(const Scene& scene) {
    return mean(host_render(scene, Precision::single_precision).image, "R");
}

} // namespace

TEST_CASE("Old bsdfs: names and numbers of Mitsuba 0.6", "[old]") {
    Scene scene = ball_of("<bsdf type='phong'><float name='exponent' value='256'/><rgb "
                          "name='diffuseReflectance' value='.1,.2,.3'/><spectrum "
                          "name='specularReflectance' value='.3'/></bsdf>");
    CHECK(scene.notes.empty());
    auto phong = only_bsdf<PhongBsdf>(scene);
    CHECK(phong.exponent.constant == 256);
    CHECK(phong.diffuse_reflectance.constant == Rgb(0.1, 0.2, 0.3));
    CHECK(phong.specular_reflectance.constant == Rgb(0.3));
    auto ward = only_bsdf<WardBsdf>(
        ball_of("<bsdf type='ward'><string name='variant' value='Ward-Duer'/><float name='alphaV' "
                "value='.3'/></bsdf>"));
    CHECK(ward.roughness.variant == WardVariant::ward_duer);
    CHECK(ward.roughness.alpha_u.constant == 0.1);
    CHECK(ward.roughness.alpha_v.constant == 0.3);
    ward = only_bsdf<WardBsdf>(ball_of("<bsdf type='ward'><float name='alpha' value='.4'/><float "
                                       "name='alpha_u' value='.2'/></bsdf>",
                                       "3.0.0"));
    CHECK(ward.roughness.variant == WardVariant::balanced);
    CHECK(ward.roughness.alpha_u.constant == 0.2);
    CHECK(ward.roughness.alpha_v.constant == 0.4);
    CHECK_THAT(refusal_of_body("<bsdf type='ward'><string name='variant' value='new'/></bsdf>"),
               Contains("balanced, ward, ward-duer"));
    CHECK_THAT(refusal_of_body("<bsdf type='phong'><float name='exponent' value='-1'/></bsdf>"),
               Contains("0 to 1e+18"));
}

TEST_CASE("Old bsdfs: reflectances of more than 1 together are scaled as Mitsuba 0.6 does",
          "[old]") {
    const std::string much = "<bsdf type='phong'><rgb name='diffuseReflectance' value='.8,.1,.6'/>"
                             "<rgb name='specularReflectance' value='.2,.9,.6'/>";
    Reflectances scaled = packed(ball_of(much + "</bsdf>")); // 1.2 together at most
    CHECK(near(scaled.diffuse, 0.825 * Rgb(0.8, 0.1, 0.6)));
    CHECK(near(scaled.specular, 0.825 * Rgb(0.2, 0.9, 0.6)));
    Reflectances kept =
        packed(ball_of(much + "<boolean name='ensureEnergyConservation' value='false'/></bsdf>"));
    CHECK(near(kept.diffuse, Rgb(0.8, 0.1, 0.6)));
    CHECK(near(kept.specular, Rgb(0.2, 0.9, 0.6)));
    Reflectances whole = packed(ball_of("<bsdf type='ward'><rgb name='diffuseReflectance' "
                                        "value='.25'/><rgb name='specularReflectance' "
                                        "value='.75'/></bsdf>"));
    CHECK(whole.diffuse == Rgb(0.25));
    CHECK(whole.specular == Rgb(0.75));
}

TEST_CASE("Old bsdfs: textures count by the highest of each component", "[old]") {
    // At most 0.5 of red and 0.9 of green: together 0.9, 1.4 and 0.9.
    TexelSource image = texels_of(2, 1, 3, TexelComponent::single, {.5f, .1f, 0, .2f, .9f, 0});
    PhongBsdf phong;
    phong.diffuse_reflectance = textured(image);
    phong.specular_reflectance = Rgb(0.4, 0.5, 0.9);
    Reflectances scaled = packed(sheet_of(phong));
    CHECK(near(scaled.diffuse, Rgb(0.99 / 1.4))); // times the texture
    CHECK(near(scaled.specular, 0.99 / 1.4 * Rgb(0.4, 0.5, 0.9)));
    phong.ensure_energy_conservation = false;
    CHECK(packed(sheet_of(phong)).diffuse == Rgb(1));
    // Bytes are decoded, a checkerboard has two colours.
    phong.ensure_energy_conservation = true;
    phong.diffuse_reflectance =
        textured(texels_of(1, 1, 3, TexelComponent::byte, {188, 188, 188}, true)); // 0.502887
    phong.specular_reflectance = textured(
        Texture{"", glm::dmat3(1), CheckerboardTexture{Rgb(0.7, 0.2, 0.1), Rgb(0.1, 0.3, 0.8)}});
    scaled = packed(sheet_of(phong));
    CHECK(scaled.diffuse.r == Approx(0.99 / 1.302887).epsilon(1e-5));
    CHECK(scaled.specular.r == Approx(0.99 / 1.302887).epsilon(1e-5));
    phong.diffuse_reflectance = Rgb(0.1);
    CHECK(packed(sheet_of(phong)).specular == Rgb(1));
}

TEST_CASE("Old bsdfs: what sheets of them show of an even sky", "[old]") {
    // Along the normal Phong's lobe sends on its reflectance, Ward's balanced one
    // 1 - a^2 + a^2 exp(-1 / a^2) of it.
    for (double exponent : {1.0, 30.0, 1e6}) {
        PhongBsdf phong{exponent, Rgb(0.3), Rgb(0.6)};
        CHECK(seen(sheet_of(phong)) == Approx(0.9).epsilon(2e-3));
        phong.specular_reflectance =
            textured(Texture{"", glm::dmat3(1), CheckerboardTexture{Rgb(0.4), Rgb(0.4)}});
        phong.exponent = Textured<double>(
            textured(
                Texture{"", glm::dmat3(1), CheckerboardTexture{Rgb(exponent), Rgb(2 * exponent)}})
                .texture);
        CHECK(seen(sheet_of(phong)) == Approx(0.7).epsilon(2e-3));
    }
    WardBsdf ward{{WardVariant::balanced, 0.5, 0.5}, Rgb(0.2), Rgb(0.7)};
    CHECK(seen(sheet_of(ward)) == Approx(0.2 + 0.7 * (0.75 + 0.25 * std::exp(-4))).epsilon(2e-3));
}

TEST_CASE("Old bsdfs: numbers of colours are said to count by their luminance", "[old]") {
    SceneFolder folder;
    folder.write("c.pfm", pfm_of(1, 1, {5, 5, 5}, 3));
    folder.write("g.pfm", pfm_of(1, 1, {5}, 1));
    auto notes = [&](const std::string& file) {
        return load_scene(
                   folder.write("scene.xml",
                                scene_text("<shape type='sphere'><bsdf type='phong'><texture "
                                           "type='bitmap' name='exponent'><string name='filename' "
                                           "value='" +
                                               file + "'/></texture></bsdf></shape>",
                                           "0.6.0")))
            .notes;
    };
    REQUIRE(notes("c.pfm").size() == 1);
    CHECK_THAT(notes("c.pfm")[0], Contains("by their luminance"));
    CHECK(notes("g.pfm").empty());
}
