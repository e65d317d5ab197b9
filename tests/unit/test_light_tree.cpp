// The light tree: every light in one leaf, bounds that hold, and a choice that misses no light.
#include "host/flatten/light_bounds.h"
#include "host/twin/device_functions.h"
#include "tests/support/many_lights_scene.h"

#include <catch2/catch.hpp>
#include <glm/vector_relational.hpp>

#include "host/numerics/light_tables.h"

using namespace parhelion;
using namespace parhelion::numerics;
using namespace parhelion::test;

namespace {

/// A point of the scene as the device has it.
f32::vec3 in_frame(const DeviceScene& scene, f64::vec3 p) {
    glm::vec3 q(scene.frame.point({p.x, p.y, p.z}));
    return {q.x, q.y, q.z};
}

double sum_of(const std::vector<double>& values) {
    double sum = 0;
    for (double v : values)
        sum += v;
    return sum;
}

} // namespace

TEST_CASE("Light tree: every light has one leaf, and parents and children know each other") {
    for (int count : {2, 3, 8, 100, 5000})
        for (LightChoice choice : {LightChoice::importance, LightChoice::power}) {
            DeviceScene scene = make_device_scene(many_lights_scene(count, true), choice);
            const auto& nodes = scene.light_tree.nodes;
            REQUIRE(nodes.size() == 2 * scene.lights.size() - 2);
            REQUIRE(scene.light_tree.leaves.size() == scene.lights.size());
            for (std::size_t row = 0; row < scene.lights.size(); row++)
                CHECK(nodes[std::size_t(scene.light_tree.leaves[row])].child == ~int(row));
            for (std::size_t i = 0; i < nodes.size(); i++) {
                CHECK((nodes[i].parent < 0) == (i < 2));
                int child = nodes[i].child;
                if (child < 0) continue;
                CHECK(child % 2 == 0);
                CHECK(nodes[std::size_t(child)].parent == int(i));
                CHECK(nodes[std::size_t(child) + 1].parent == int(i));
            }
        }
    CHECK(make_device_scene(many_lights_scene(1, false)).light_tree.nodes.empty());
}

TEST_CASE(
    "Light tree: probabilities add up to one, but for groups that turn out dark, and no light "
    "that shines is left out") {
    Random random(95);
    for (int count : {2, 8, 100, 1000}) {
        DeviceScene scene = make_device_scene(many_lights_scene(count, true));
        for (int repeat = 0; repeat < 100; repeat++) {
            f32::vec3 p = in_frame(scene, random.point<F64>(9)), n = random.direction<F32>();
            std::vector<double> pmf = light_probabilities(scene, p, n, false),
                                hint = light_probabilities(scene, p, n, true);
            // The bounds of a group may promise light that neither of its halves has.
            CHECK(sum_of(pmf) < 1 + 1e-5);
            CHECK(sum_of(hint) < 1 + 1e-5);
            for (std::size_t row = 0; row < pmf.size(); row++) {
                f32::Light light = lanes_of(scene.lights[row]);
                auto s = emitter_sample(light, p, random.square<F32>());
                if (max_component(s.weight) > 0 && !(pmf[row] > 0 && hint[row] > 0))
                    FAIL("light " << row << " of " << count << " shines and is never picked");
            }
        }
    }
}

TEST_CASE("Light tree: what is picked has its probability, and the hint that a ray will be told") {
    Random random(97);
    for (int count : {2, 8, 300}) {
        DeviceScene scene = make_device_scene(many_lights_scene(count, true));
        for (int repeat = 0; repeat < 50; repeat++) {
            f32::vec3 p = in_frame(scene, random.point<F64>(9)), n = random.direction<F32>();
            std::vector<double> pmf = light_probabilities(scene, p, n, false),
                                hint = light_probabilities(scene, p, n, true);
            for (int draw = 0; draw < 20; draw++) {
                PickedLight pick = pick_light(scene.light_tree, {p.x, p.y, p.z}, {n.x, n.y, n.z},
                                              random.bits(), random.bits());
                if (!(pick.pmf > 0)) continue; // a group that turned out dark
                auto row = std::size_t(pick.row);
                CAPTURE(count, row);
                CHECK(pick.pmf == Approx(pmf[row]).epsilon(1e-4));
                CHECK(pick.pmf_hint == Approx(hint[row]).epsilon(1e-4));
                CHECK(light_pmf(scene.light_tree, {p.x, p.y, p.z}, pick.row) ==
                      Approx(hint[row]).epsilon(1e-4));
            }
        }
    }
}

TEST_CASE("Light tree: by power every light has its share of it, everywhere") {
    DeviceScene scene = make_device_scene(many_lights_scene(100, true), LightChoice::power);
    std::vector<double> pmf =
        light_probabilities(scene, in_frame(scene, {1, 2, 3}), {0, 1, 0}, false);
    for (std::size_t row = 0; row < pmf.size(); row++)
        CHECK(pmf[row] == Approx(scene.lights[row].pmf).epsilon(1e-4));
}

TEST_CASE("Light tree: lights of any brightness have their share") {
    for (double brightness : {1e-44, 1e-38, 1e30}) {
        Scene scene = many_lights_scene(1, false);
        scene.emitters = {PointEmitter{{0, 3, 1}, Rgb(brightness)},
                          PointEmitter{{0, 3, -1}, Rgb(brightness)}};
        scene.shapes.pop_back(); // the lamp
        DeviceScene device = make_device_scene(scene);
        std::vector<double> pmf =
            light_probabilities(device, in_frame(device, {0, 0, 0}), {0, 1, 0}, false);
        CHECK(pmf == std::vector{0.5, 0.5});
    }
}

TEST_CASE("Light table: no light is too bright or too far for single precision") {
    Scene scene = many_lights_scene(1, false);
    for (double brightness : {1e-300, 1e-44, 1.0, 3e38, 1e300})
        for (double place : {1.0, 1e10, 1e38, 1e300}) {
            CAPTURE(brightness, place);
            scene.emitters = {PointEmitter{{place, 3, 1}, Rgb(brightness)},
                              PointEmitter{{-place, 3, -1}, Rgb(brightness)},
                              SpotEmitter{{0, place, 0}, {0, -1, 0}, 0.5, 0.3, Rgb(brightness)}};
            DeviceScene device = make_device_scene(scene);
            double largest = 0;
            for (const LightRecord& l : device.lights) {
                for (float v : {l.ax, l.ay, l.az, l.r, l.g, l.b, l.pmf, l.extra})
                    CHECK(std::isfinite(v));
                largest = std::max(largest, double{l.r});
            }
            CHECK(largest >= 0x1p-90);
            for (const LightNodeRecord& n : device.light_tree.nodes)
                CHECK(std::isfinite(n.cx + n.cy + n.cz + n.radius + n.intensity));
        }
    scene.emitters = {PointEmitter{{-1e308, 0, 0}, Rgb(1)}};
    scene.camera.to_world[3] = {1e308, 0, 0, 1};
    scene.shapes = {shape_of(quad({1e308, -1e300, 0}, {0, 1e300, 0}, {0, 0, 1e300}), 0, 0)};
    CHECK_THROWS_WITH(make_device_scene(scene), Catch::Contains("made by the test: the distance"));
}

TEST_CASE("Light tree: what has no place is chosen by what it sends to the point, as the rest is") {
    // A lamp of one intensity, two units above a floor, under a sky or a sun: by irradiance, and of
    // the lamp by its cosine.
    Scene scene = many_lights_scene(1, false);
    scene.shapes.pop_back(); // the lamp
    const double intensity = 5, height = 2, x = 1.5;
    const double squared = height * height + x * x, cosine = height / std::sqrt(squared);
    const double lamp = intensity / squared * cosine;
    for (bool sun : {false, true}) {
        scene.emitters = {PointEmitter{{0, height, 0}, Rgb(intensity)}};
        if (sun)
            scene.emitters.emplace_back(DirectionalEmitter{{0, -1, 0}, Rgb(0.7)});
        else
            scene.emitters.emplace_back(ConstantEmitter{Rgb(0.3)});
        const double distant = sun ? 0.7 : 0.3 * M_PI;
        DeviceScene device = make_device_scene(scene);
        std::vector<double> pmf =
            light_probabilities(device, in_frame(device, {x, 0, 0}), {0, 1, 0}, false);
        REQUIRE(pmf.size() == 2);
        CHECK(pmf[0] == Approx(lamp / (lamp + distant)).epsilon(1e-5));
        CHECK(pmf[1] == Approx(distant / (lamp + distant)).epsilon(1e-5));
    }
}

TEST_CASE("Light tree: by power a sky has its share of it whatever is near") {
    DeviceScene scene = make_device_scene(many_lights_scene(100, true), LightChoice::power);
    std::vector<double> pmf =
        light_probabilities(scene, in_frame(scene, {1, 0.5, 3}), {0, 1, 0}, false);
    double share = scene.lights[std::size_t(scene.sky_light)].pmf;
    CHECK(pmf[std::size_t(scene.sky_light)] == Approx(share).epsilon(1e-5));
}

TEST_CASE("Light tree: merged cones hold both, merged boxes too") {
    Random random(96);
    auto random_bounds = [&] {
        LightBounds b;
        auto w = random.direction<F64>();
        b.axis = {w.x, w.y, w.z};
        b.cos_spread = random.between(-1, 1);
        b.low = {random.unit(), random.unit(), random.unit()};
        b.high = b.low + glm::dvec3(random.unit());
        return b;
    };
    for (int n = 0; n < 20000; n++) {
        LightBounds a = random_bounds(), b = random_bounds(), m = merge(a, b);
        CHECK((glm::all(glm::lessThanEqual(m.low, a.low)) &&
               glm::all(glm::greaterThanEqual(m.high, b.high))));
        CHECK(glm::length(m.axis) == Approx(1).epsilon(1e-9));
        for (const LightBounds& part : {a, b}) {
            double reach = std::acos(glm::clamp(glm::dot(part.axis, m.axis), -1.0, 1.0)) +
                           std::acos(part.cos_spread);
            CHECK((m.cos_spread <= -1 || reach <= std::acos(m.cos_spread) + 1e-6));
        }
    }
}

TEST_CASE("Light importance: never negative, and none from behind") {
    LightNodeRecord r{};
    r.ay = -1; // a lamp that shines down, at height 2
    r.cy = 2, r.radius = 0.1f;
    r.intensity = 3; // by Lambert's law
    f32::vec3 up = {0, 1, 0};
    CHECK(light_importance(lanes_of(r), {0, 0, 0}, up).to_surface == Approx(0.75));
    CHECK(light_importance(lanes_of(r), {0, 4, 0}, up).to_point == 0);
    CHECK(light_importance(lanes_of(r), {0, 2.05f, 0}, up).to_point > 0); // within its sphere
    Random random(97);
    for (int n = 0; n < 100000; n++) {
        auto axis = random.direction<F32>();
        r.ax = axis.x, r.ay = axis.y, r.az = axis.z;
        r.spread = float(random.between(-1, 2));
        auto i = light_importance(lanes_of(r), random.point<F32>(4), random.direction<F32>());
        if (!(i.to_surface >= 0 && i.to_point >= i.to_surface * 0.999999f)) FAIL("at " << n);
    }
}
