// Coarse spheres with smooth normals: faces turned away from the light are dark, and what shading
// normals are asked for is what is rendered.
#include "host/flatten/scene_features.h"
#include "host/numerics/smooth_spheres.h"
#include "tests/support/render_scene.h"

#include <catch2/catch.hpp>

using namespace parhelion;
using namespace parhelion::numerics;

namespace {

Scene panel_scene(const NamedBsdf& bsdf, ShadingNormals normals) {
    Scene scene = smooth_spheres({bsdf}, Spheres::open_to_the_right, 200, 1);
    add_panel(scene, far_panel);
    scene.integrator.max_depth = 2;
    scene.integrator.shading_normals = normals;
    scene.integrator.aovs = {{"ng", "geo_normal", {}}, {"p", "position", {}}};
    return scene;
}

FeatureSet features_of(const Scene& scene) { return make_device_scene(scene).features.on(); }

} // namespace

TEST_CASE("Shading normals: faces that are turned away from the light are dark", "[render]") {
    for (const NamedBsdf& bsdf : white_bsdfs()) {
        if (bsdf.transparent || bsdf.name == "mirror") continue; // no mirror shows the panel
        CAPTURE(bsdf.name);
        auto count = [&](ShadingNormals normals) {
            return turned_away(test::render_quietly(panel_scene(bsdf, normals)).image, 0);
        };
        for (ShadingNormals normals : {ShadingNormals::consistent, ShadingNormals::soft}) {
            TurnedAway kept = count(normals);
            CHECK(kept.lit == 0);
            CHECK(kept.dark > 1000);
        }
        CHECK(count(ShadingNormals::raw).lit > 20);
    }
}

TEST_CASE("Shading normals: only lit smooth meshes have kernels that keep to the geometry",
          "[render]") {
    auto keeps = [](const Scene& s) { return features_of(s).has(feature_consistent_normals); };
    auto fades = [](const Scene& s) { return features_of(s).has(feature_soft_terminator); };
    NamedBsdf diffuse = white_bsdfs()[0];
    Scene scene = panel_scene(diffuse, ShadingNormals::consistent);
    CHECK((keeps(scene) && !fades(scene)));
    CHECK_FALSE(keeps(panel_scene(diffuse, ShadingNormals::raw)));
    Scene soft = panel_scene(diffuse, ShadingNormals::soft);
    CHECK((keeps(soft) && fades(soft)));
    scene.integrator.kind = IntegratorKind::normals;
    CHECK_FALSE(keeps(scene));
    scene = panel_scene(diffuse, ShadingNormals::consistent);
    std::get<Mesh>(scene.shapes[0].geometry).normals.clear();
    CHECK_FALSE(keeps(scene));
}

TEST_CASE("Shading normals: the command line says which", "[render]") {
    RenderCommand command;
    command.scene_file = test::source_file("scenes/cornell-box/scene.xml");
    CHECK(test::load(command).integrator.shading_normals == ShadingNormals::consistent);
    command.shading_normals = "raw";
    CHECK(test::load(command).integrator.shading_normals == ShadingNormals::raw);
    command.shading_normals = "soft";
    CHECK(test::load(command).integrator.shading_normals == ShadingNormals::soft);
    command.shading_normals = "smooth";
    CHECK_THROWS_WITH(test::load(command), Catch::Contains("--shading-normals") &&
                                               Catch::Contains("consistent") &&
                                               Catch::Contains("soft") && Catch::Contains("raw"));
}
