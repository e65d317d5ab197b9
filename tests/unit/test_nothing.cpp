// Scenes of nothing and lights of no power: tables without rows, and features that go by the rows.
#include "host/twin/sample_trace.h"
#include "tests/support/host_render.h"
#include "tests/support/two_of_every.h"

#include <catch2/catch.hpp>

using namespace parhelion;
using namespace parhelion::test;

namespace {

Scene small(Scene scene) {
    scene.film.width = scene.film.crop_width = 5;
    scene.film.height = scene.film.crop_height = 3;
    scene.film.pixel_format = PixelFormat::rgba;
    scene.sampler.samples_per_pixel = 4;
    set_energy_compensation(scene, false);
    scene.integrator.aovs = {{"al", "albedo", {}}, {"uv", "uv", {}}, {"si", "shape_index", {}}};
    return scene;
}

/// Renders in both precisions and traces: the largest value of R, G, B.
float brightest(const Scene& scene) {
    float most = 0;
    for (Precision precision : {Precision::single_precision, Precision::double_precision}) {
        RenderResult result = host_render(scene, precision);
        CHECK(result.report.non_finite_samples == 0);
        for (const char* channel : {"R", "G", "B"})
            for (float v : find_channel(result.image, channel)->values)
                most = std::max(most, std::abs(v));
    }
    SampleTrace trace = trace_sample(scene, make_device_scene(scene), 1, 1, 1);
    for (float v : trace.radiance)
        most = std::max(most, std::abs(v));
    return most;
}

/// Every integrator, direct light by either strategy, emitters hidden and shown.
template<class Visit>
void for_each_integrator(Scene scene, Visit visit) {
    for (IntegratorKind kind : {IntegratorKind::path, IntegratorKind::direct, IntegratorKind::depth,
                                IntegratorKind::normals, IntegratorKind::aov})
        for (bool hide : {false, true})
            for (int strategies : {1, 2, 3}) {
                scene.integrator.kind = kind;
                scene.integrator.hide_emitters = hide;
                scene.integrator.emitter_samples = strategies & 1;
                scene.integrator.bsdf_samples = strategies & 2;
                CAPTURE(int(kind), hide, strategies);
                visit(scene);
            }
}

bool shows_light(const Scene& scene) {
    return scene.integrator.kind == IntegratorKind::path ||
           scene.integrator.kind == IntegratorKind::direct;
}

} // namespace

TEST_CASE("A scene of nothing renders", "[nothing]") {
    Scene empty = small(two_of_every());
    empty.materials.clear(), empty.shapes.clear(), empty.emitters.clear();
    Scene empty_mesh = empty;
    empty_mesh.shapes.push_back(shape_of(Mesh{}, no_material, no_material, Rgb(1)));
    Scene no_materials = empty;
    no_materials.shapes.push_back(shape_of(Sphere{}, no_material, no_material));
    Scene only_sky = empty;
    only_sky.emitters = {ConstantEmitter{Rgb(1)}};
    Scene one_pixel = small(two_of_every());
    one_pixel.film.width = one_pixel.film.crop_width = 1;
    one_pixel.film.height = one_pixel.film.crop_height = 1;
    for (const Scene& scene : {empty, empty_mesh, no_materials})
        for_each_integrator(scene, [](const Scene& s) {
            float most = brightest(s);
            if (shows_light(s)) CHECK(most == 0);
        });
    for_each_integrator(only_sky, [](const Scene& s) {
        CHECK(brightest(s) == (shows_light(s) && !s.integrator.hide_emitters ? 1.f : 0.f));
    });
    CHECK(host_render(one_pixel, Precision::single_precision).image.pixel_count() == 1);
}

TEST_CASE("A light of no power is no light, and takes no feature", "[nothing]") {
    for (const LightKind& kind : light_kinds) {
        CAPTURE(kind.name);
        Scene scene = small(two_of_every());
        scene.shapes.resize(object_count);
        scene.emitters.clear();
        Scene without = scene;
        kind.add(scene, 0, Rgb(0), Where::room);
        DeviceScene flat = make_device_scene(scene);
        CHECK(flat.lights.empty());
        CHECK(!flat.features.has(kind.feature));
        for_each_integrator(scene, [](const Scene& s) {
            if (shows_light(s)) CHECK(brightest(s) == 0);
        });
        // Beside one of power it changes nothing but what stands in the way.
        kind.add(scene, 1, Rgb(3, 2, 1), Where::room);
        kind.add(without, 1, Rgb(3, 2, 1), Where::room);
        DeviceScene lit = make_device_scene(scene), alone = make_device_scene(without);
        CHECK(lit.lights.size() == alone.lights.size());
        CHECK(lit.features == alone.features);
    }
}

TEST_CASE("Paths have the features that their length leaves a use for", "[nothing]") {
    Scene scene = small(two_of_every());
    struct Length {
        int max_depth;
        bool emission, next_event, scattering;
    };
    for (Length l : {Length{0, false, false, false},
                     {1, true, false, false},
                     {2, true, true, true},
                     {3, true, true, true},
                     {-1, true, true, true}}) {
        CAPTURE(l.max_depth);
        scene.integrator.max_depth = l.max_depth;
        FeatureDecisions features = make_device_scene(scene).features;
        CHECK(features.has(feature_emission) == l.emission);
        CHECK(features.has(feature_next_event) == l.next_event);
        CHECK(features.has(feature_scattering) == l.scattering);
    }
}

TEST_CASE("Texture coordinates are read for lobes that lie along them, and not for others",
          "[nothing]") {
    for (Example example : example_materials)
        for (int which : {0, 1}) {
            Bsdf bsdf = example(which);
            bool anisotropic = std::visit(
                [](const auto& b) {
                    if constexpr (requires { b.roughness.alpha_u; })
                        return !(b.roughness.alpha_u == b.roughness.alpha_v);
                    if constexpr (requires { b.anisotropic; }) return b.anisotropic.constant > 0;
                    return false;
                },
                bsdf);
            Scene scene;
            scene.materials.push_back({"", {}, bsdf});
            Mesh mesh = quad({0, 0, -3}, {1, 0, 0}, {0, 1, 0});
            mesh.uvs = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
            scene.shapes.push_back(shape_of(mesh, 0, 0));
            INFO("kind " << bsdf.index() << ", example " << which);
            CHECK(make_device_scene(scene).features.has(feature_vertex_uvs) == anisotropic);
        }
}

TEST_CASE("Features are those of the records", "[nothing]") {
    Scene scene = small(two_of_every());
    auto has = [&](Feature f) { return make_device_scene(scene).features.has(f); };
    CHECK(has(feature_shape_triangle));
    CHECK(has(feature_vertex_normals));
    std::erase_if(scene.shapes,
                  [](const Shape& s) { return std::holds_alternative<Mesh>(s.geometry); });
    Mesh empty;
    empty.normals = {{0, 0, 1}}, empty.uvs = {{0, 0}}, empty.positions = {{0, 0, 0}};
    scene.shapes.push_back(shape_of(empty, 0, 1, Rgb(1)));
    CHECK(!has(feature_shape_triangle));
    CHECK(!has(feature_vertex_normals));
    CHECK(!has(feature_vertex_uvs));
    CHECK(!has(feature_emitter_area_triangle));
}
