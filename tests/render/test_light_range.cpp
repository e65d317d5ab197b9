// Lights as bright or as dim as single precision can say, and beyond: the same image in another
// unit, whatever its sums and squares would overflow to.
#include "host/numerics/every_kind_scene.h"
#include "host/render/host_render.h"
#include "host/twin/sample_trace.h"
#include "tests/support/render_scene.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <bit>
#include <cmath>

using namespace parhelion;
using namespace parhelion::test;
using namespace parhelion::numerics;

namespace {

Scene every_light() {
    Scene scene = every_kind_scene();
    scene.film.width = scene.film.crop_width = 12;
    scene.film.height = scene.film.crop_height = 9;
    scene.integrator.aovs.resize(4); // without `samples`
    return scene;
}

Scene times(Scene scene, double factor) {
    for (Shape& shape : scene.shapes)
        if (shape.radiance) *shape.radiance *= factor;
    for (Emitter& emitter : scene.emitters)
        strength_of(emitter) *= factor;
    return scene;
}

/// By how much a channel grows if all lights are so much brighter.
double growth(const std::string& channel, double factor) {
    if (channel == "R" || channel == "G" || channel == "B") return factor;
    if (channel.starts_with("variance") || channel.starts_with("second_moment"))
        return factor * factor;
    return 1;
}

/// Values that are not those of `reference` in another unit, to the bit; as far as single precision
/// holds them without loss.
int wrong_values(const Image& reference, const Image& image, double factor) {
    int wrong = 0, kept = 0;
    for (const Channel& channel : reference.channels) {
        const std::vector<float>& values = find_channel(image, channel.name)->values;
        double by = growth(channel.name, factor);
        for (std::size_t i = 0; i < values.size(); i++) {
            double truth = channel.values[i] * by;
            if (truth != 0 && !(std::fabs(truth) >= 0x1p-126 && std::fabs(truth) < 0x1p127))
                continue;
            kept += growth(channel.name, 2) != 1;
            wrong += std::bit_cast<unsigned>(values[i]) !=
                     std::bit_cast<unsigned>(static_cast<float>(truth));
        }
    }
    CHECK(kept > 300);
    return wrong;
}

Scene sky(double radiance, int spp) {
    Scene scene;
    scene.file = "made by the test";
    scene.emitters = {ConstantEmitter{Rgb(radiance)}};
    scene.film.width = scene.film.crop_width = scene.film.height = scene.film.crop_height = 4;
    scene.film.filter.kind = FilterKind::box;
    scene.sampler.samples_per_pixel = spp;
    return scene;
}

std::vector<Image> on_every_path(const Scene& scene) {
    Progress quiet(Progress::Mode::quiet);
    return {render_quietly(scene).image,
            render_on_host(scene, {}, Precision::single_precision, quiet).image,
            render_on_host(scene, {}, Precision::double_precision, quiet).image};
}

} // namespace

TEST_CASE("Light range: all lights brighter or dimmer by a power of two, and all that follows",
          "[render]") {
    Scene scene = every_light();
    Image reference = render_quietly(scene).image;
    for (int exponent : {-110, -60, -30, 30, 60, 100, 118}) {
        double factor = std::exp2(exponent);
        CAPTURE(exponent);
        RenderResult result = render_quietly(times(scene, factor));
        CHECK(result.report.non_finite_samples == 0);
        CHECK(wrong_values(reference, result.image, factor) == 0);
    }
}

TEST_CASE("Light range: pixels of the largest numbers there are, and squares of those",
          "[render]") {
    for (double radiance : {1e-30, 1.0, 1e19, 1e20, 1e37, 1e38, 3.4e38})
        for (int spp : {1, 64}) {
            CAPTURE(radiance, spp);
            for (const Image& image : on_every_path(sky(radiance, spp)))
                for (float v : find_channel(image, "G")->values)
                    CHECK(v == Approx(radiance).epsilon(1e-6));
        }
    Scene scene = sky(1e19, 16); // whose square a float holds
    scene.integrator.second_moment = true;
    scene.integrator.aovs = {{"variance", "variance", {}}};
    for (const Image& image : on_every_path(scene)) {
        for (float v : find_channel(image, "second_moment.R")->values)
            CHECK(v == Approx(1e38).epsilon(1e-6));
        for (float v : find_channel(image, "variance.R")->values)
            CHECK((v >= 0 && v < 1e26f)); // rounding alone
    }
    // Beyond, the value is infinite, and whoever writes it says so; no variance is no number.
    scene.emitters = {ConstantEmitter{Rgb(1e20)}};
    for (const Image& image : on_every_path(scene)) {
        for (float v : find_channel(image, "second_moment.R")->values)
            CHECK(v == INFINITY);
        for (float v : find_channel(image, "variance.R")->values)
            CHECK((v >= 0 && v < 1e28f));
    }
}

TEST_CASE("Light range: a point light as far as a double says shines as a sun", "[render]") {
    auto plate = [](const Emitter& emitter) {
        Scene scene = sky(0, 4);
        scene.materials.push_back({"", {}, DiffuseBsdf{Rgb(0.5)}});
        scene.shapes = {shape_of(quad({-9, -9, 0}, {18, 0, 0}, {0, 18, 0}), 0, 0)};
        scene.camera.to_world = glm::dmat4(glm::dvec4(-1, 0, 0, 0), glm::dvec4(0, 1, 0, 0),
                                           glm::dvec4(0, 0, -1, 0), glm::dvec4(0, 0, 4, 1));
        scene.emitters = {emitter};
        return scene;
    };
    glm::dvec3 from(0.6, 0, 0.8);
    Image truth = render_quietly(plate(DirectionalEmitter{-from, Rgb(2)})).image;
    for (double distance : {1e8, 1e15, 1e25, 1e38, 1e100}) {
        CAPTURE(distance);
        Rgb intensity(2 * distance * distance);
        for (const Emitter& emitter :
             {Emitter(PointEmitter{distance * from, intensity}),
              Emitter(SpotEmitter{distance * from, -from, 0.5, 0.3, intensity})})
            for (const Image& image : on_every_path(plate(emitter)))
                for (std::size_t i = 0; i < image.pixel_count(); i++)
                    CHECK(find_channel(image, "G")->values[i] ==
                          Approx(find_channel(truth, "G")->values[i]).epsilon(2e-6));
    }
    // A sun of that kind leaves the others their digits, variances included.
    Scene sunny = plate(PointEmitter{1.5e11 * from, Rgb(1e25)});
    DeviceScene flat = make_device_scene(sunny);
    CHECK(flat.frame.radiance_unit == 1);
    // Beside lights that are near, one that brings nothing is chosen by nobody.
    Scene scene = plate(PointEmitter{{-1e38, 0, 0}, Rgb(1)});
    scene.emitters.push_back(PointEmitter{{0, 3, 3}, Rgb(1)});
    scene.emitters.push_back(PointEmitter{{0, 3, 4}, Rgb(1)});
    for (const Image& image : on_every_path(scene)) {
        const std::vector<float>& values = find_channel(image, "G")->values;
        CHECK(
            std::all_of(values.begin(), values.end(), [](float v) { return v > 0.001f && v < 1; }));
    }
    SampleTrace trace = trace_sample(scene, make_device_scene(scene), 1, 1, 0);
    CHECK(trace.first_not_finite == -1);
    CHECK(trace.radiance[0] > 0);
}
