// Every feature, integrator, AOV and switch off and on, alone and in pairs, in scenes with two
// different ones of every light, material and shape: what is seen of a light is its own radiance,
// and an image of all lights is the sum of the images of each.
#include "tests/support/every_switch.h"
#include "tests/support/every_two.h"
#include "tests/support/host_render.h"
#include "tests/support/render_scene.h"

#include <catch2/catch.hpp>

#include <cmath>

using namespace parhelion;
using namespace parhelion::test;

namespace {

/// Of which some colour differs by more than a thousandth.
int pixels_apart(const Image& a, const Image& b) {
    int apart = 0;
    for (std::size_t i = 0; i < a.channels[0].values.size(); i++) {
        bool differs = false;
        for (std::size_t c = 0; c < 3; c++)
            differs |= a.channels[c].values[i] !=
                       Approx(b.channels[c].values[i]).epsilon(1e-3).margin(1e-6);
        apart += differs;
    }
    return apart;
}

bool shows_light(const Integrator& i) {
    return i.kind == IntegratorKind::path || i.kind == IntegratorKind::direct;
}

/// What the middle of a tile of the panel shows: R, G, B.
Rgb panel_truth(const Scene& scene, int tile) {
    const Integrator& integrator = scene.integrator;
    Rgb nothing(0), sky(0); // of a sunsky it sees what lies below the horizon
    for (const Emitter& e : scene.emitters)
        if (const auto* constant = std::get_if<ConstantEmitter>(&e))
            sky = constant->radiance;
        else if (const auto* image = std::get_if<EnvmapEmitter>(&e))
            sky = image->radiance; // a texel of 1 is all that this camera sees of it
    bool is_lamp = tile < panel_tiles - 1;
    if (integrator.hide_emitters && (is_lamp || shows_light(integrator))) return nothing;
    if (!is_lamp) return shows_light(integrator) ? sky : nothing;
    const Shape& lamp = scene.shapes[object_count + static_cast<std::size_t>(tile)];
    if (shows_light(integrator)) return *lamp.radiance;
    glm::dvec3 to(scene.camera.orthographic ? 0.0 : tile - 4.0, 0, view_distance(scene));
    const auto* ball = std::get_if<Sphere>(&lamp.geometry);
    if (integrator.kind == IntegratorKind::depth)
        return Rgb(glm::length(to) - (ball ? ball->radius : 0));
    if (integrator.kind == IntegratorKind::aov) return nothing;
    glm::dvec3 n = ball ? -glm::normalize(to) : glm::dvec3(0, 0, -1);
    return {0.5 * (n.x + 1), 0.5 * (n.y + 1), 0.5 * (n.z + 1)};
}

/// The largest difference from the truth of a tile: relative; of views, whose value changes over a
/// pixel, in hundredths.
double panel_error(const Scene& scene, const Image& image) {
    double worst = 0;
    const auto &r = find_channel(image, "R")->values, &g = find_channel(image, "G")->values,
               &b = find_channel(image, "B")->values;
    for (int tile = 0; tile < panel_tiles; tile++) {
        std::size_t i = tile_centre(tile);
        Rgb truth = panel_truth(scene, tile);
        double off = std::max(
            {std::abs(r[i] - truth.r), std::abs(g[i] - truth.g), std::abs(b[i] - truth.b)});
        bool light = shows_light(scene.integrator);
        double scale = std::max({truth.r, truth.g, truth.b, light ? 1e-30 : 1.0});
        worst = std::max(worst, (light ? 1 : 1e-5) * off / scale);
    }
    return worst;
}
// Sums of up to 50 weighted values of one size.
constexpr double panel_tolerance = 50 * 0x1p-24;

Setup panel_setup() {
    Setup setup{panel_scene(), {}};
    // Tables that the panel does not look at.
    set_energy_compensation(setup.scene, false);
    return setup;
}

struct Estimate {
    double mean = 0, variance = 0; ///< of the mean of an image's R, G and B
};

/// `variance` and `samples` of the film are those of a pixel; pixels are independent.
Estimate estimate(Setup setup) {
    setup.scene.integrator.aovs = {{"variance", "variance", {}}, {"samples", "samples", {}}};
    setup.scene.sampler.pattern = SamplePattern::independent;
    Image image = host_render(setup.scene, Precision::single_precision, setup.options).image;
    auto n = static_cast<double>(image.pixel_count());
    Estimate e;
    for (const char* channel : {"R", "G", "B"})
        for (std::size_t i = 0; i < image.pixel_count(); i++) {
            double samples = find_channel(image, "samples.N")->values[i];
            e.mean += find_channel(image, channel)->values[i] / n;
            // The three go together at worst.
            e.variance += 3 * find_channel(image, std::string("variance.") + channel)->values[i] /
                          samples / (n * n);
        }
    return e;
}

/// Standard errors between an image of all lights and the sum of the images of each.
double sum_error(const Setup& setup) {
    Setup all = setup;
    all.scene.sampler.samples_per_pixel = 64;
    Estimate together = estimate(all), sum;
    for (const Light& light : example_lights()) {
        Setup alone = setup;
        leave_light(alone.scene, light);
        alone.scene.sampler.samples_per_pixel = 16;
        Estimate e = estimate(alone);
        sum.mean += e.mean, sum.variance += e.variance;
    }
    double variance = together.variance + sum.variance;
    double off = std::abs(together.mean - sum.mean);
    return variance > 0 ? off / std::sqrt(variance) : off == 0 ? 0 : 1e30;
}

} // namespace

TEST_CASE("Every feature has a switch that turns it off and on", "[every switch]") {
    for (const Switch& s : feature_switches)
        for (bool on : {false, true}) {
            CAPTURE(s.name, on);
            Setup setup{two_of_every(), {}};
            set_energy_compensation(setup.scene, false);
            s.set(setup, on);
            FeatureSet features = render_features(make_device_scene(setup.scene), setup.options);
            CHECK(features.has(s.feature) == on);
        }
}

TEST_CASE("What is seen of each light is its radiance, with every switch and every two",
          "[every switch]") {
    const std::vector<State> states = every_state();
    auto exclude = [&](std::size_t a, std::size_t b) { return states[a].of == states[b].of; };
    auto check = [&](const Group& group, Precision precision) {
        Setup setup = panel_setup();
        std::string names;
        for (std::size_t state : group)
            states[state].set(setup), names += states[state].name + "; ";
        CAPTURE(names);
        Image image = host_render(setup.scene, precision, setup.options).image;
        REQUIRE(panel_error(setup.scene, image) < panel_tolerance);
    };
    for (std::size_t state = 0; state < states.size(); state++)
        for (Precision p : {Precision::single_precision, Precision::double_precision})
            check({state}, p);
    // Each time among two others: of more, some would too often hide what another does.
    std::vector<Group> groups = groups_of_every_two(states.size(), 4, exclude);
    for (const Group& group : groups)
        check(group, Precision::single_precision);
    WARN(states.size() << " states, every two of them in " << groups.size() << " groups");
}

TEST_CASE("Every two of many are together in some group, and none that exclude each other",
          "[every switch]") {
    for (std::size_t size : {2, 3, 4, 7}) {
        const std::size_t count = 30;
        auto exclude = [](std::size_t a, std::size_t b) { return a / 3 == b / 3; };
        std::vector<std::vector<int>> met(count, std::vector<int>(count));
        std::vector<Group> groups = groups_of_every_two(count, size, exclude);
        for (const Group& group : groups)
            for (std::size_t a : group)
                for (std::size_t b : group)
                    met[a][b]++;
        for (std::size_t a = 0; a < count; a++)
            for (std::size_t b = 0; b < count; b++)
                if (a != b) CHECK((met[a][b] > 0) == !exclude(a, b));
        CHECK((size > 2 || groups.size() == count * (count - 3) / 2));
    }
}

TEST_CASE("An image of all lights is the sum of the images of each, with every switch",
          "[every switch]") {
    for (const State& state : every_state()) {
        Setup setup{two_of_every(), {}};
        set_energy_compensation(setup.scene, false);
        state.set(setup);
        if (!shows_light(setup.scene.integrator)) continue;
        CAPTURE(state.name);
        CHECK(sum_error(setup) < 6);
    }
}

TEST_CASE("Single precision is double's with every switch", "[every switch]") {
    for (const State& state : every_state()) {
        Setup setup{two_of_every(), {}};
        set_energy_compensation(setup.scene, false);
        state.set(setup);
        CAPTURE(state.name);
        // One decision in 768 paths may fall to the other side.
        CHECK(pixels_apart(
                  host_render(setup.scene, Precision::single_precision, setup.options).image,
                  host_render(setup.scene, Precision::double_precision, setup.options).image) <= 1);
    }
}

TEST_CASE("A device has the host's bits of two of everything", "[every switch]") {
    auto check = [](const Setup& setup) {
        Image host = host_render(setup.scene, Precision::single_precision, setup.options).image;
        CHECK(differing_values(render_quietly(setup.scene, setup.options).image, host).differing ==
              0);
    };
    Setup all{two_of_every(), {}};
    check(all);
    all.scene.integrator.emitter_samples = false;
    all.scene.integrator.hide_emitters = true;
    check(all);
    for (auto [sun, sky] : {std::pair(0.1, 3.0), std::pair(0.1, 0.0), std::pair(0.0, 3.0)}) {
        Setup daylight{two_of_every(), {}};
        SunskyEmitter& e = put_example_daylight(daylight.scene);
        e.sun_scale = sun, e.sky_scale = sky;
        check(daylight);
    }
    Setup panel = panel_setup();
    panel.scene.integrator.max_depth = 1;
    check(panel);
}
