// What filters that reach over pixels make of the samples: every pixel's mean, variance and number
// of samples, added up by hand in double precision from the single samples.
#include "host/flatten/camera_record.h"
#include "host/flatten/filter_table.h"
#include "host/twin/sample_trace.h"
#include "tests/support/first_hits.h"
#include "tests/support/two_of_every.h"

#include <array>
#include <cmath>

using namespace parhelion;
using namespace parhelion::test;

namespace {

constexpr int width = 7, height = 6; // neither is whole blocks
constexpr int samples = 19;          // a group, and some

struct Sample {
    double x, y; ///< pixels from the film's corner
    std::array<double, 3> radiance;
};

Scene splatted_scene(FilterKind kind) {
    Scene scene = two_of_every();
    scene.film.width = scene.film.crop_width = width;
    scene.film.height = scene.film.crop_height = height;
    scene.film.filter.kind = kind;
    scene.sampler.samples_per_pixel = samples;
    scene.integrator.aovs = {{"variance", "variance", {}}, {"samples", "samples", {}}};
    return scene;
}

/// Where on the film the camera's ray begins, found from its direction.
void place(const CameraRecord& c, Sample& s, const std::array<float, 3>& direction) {
    glm::dvec3 d(direction[0], direction[1], direction[2]), corner(c.dx, c.dy, c.dz),
        across(c.ux, c.uy, c.uz), down(c.vx, c.vy, c.vz), axis = cross(across, down);
    d = d * (dot(corner, axis) / dot(d, axis)) - corner;
    s.x = dot(d, across) / dot(across, across);
    s.y = dot(d, down) / dot(down, down);
}

std::vector<Sample> single_samples(const Scene& scene) {
    DeviceScene flat = make_device_scene(scene);
    CameraRecord camera = camera_record(scene.camera, width, height, flat.frame);
    std::vector<Sample> all;
    for (int y = 0; y < height; y++)
        for (int x = 0; x < width; x++)
            for (int n = 0; n < samples; n++) {
                SampleTrace trace = trace_sample(scene, flat, x, y, n);
                Sample s{};
                place(camera, s, trace.vertices.at(0).direction);
                REQUIRE((s.x >= x - 1e-4 && s.x <= x + 1 + 1e-4));
                REQUIRE((s.y >= y - 1e-4 && s.y <= y + 1 + 1e-4));
                for (std::size_t k = 0; k < 3; k++)
                    s.radiance[k] = trace.radiance[k];
                all.push_back(s);
            }
    return all;
}

struct Pixel {
    double mean, variance, count;
};

/// A weighted mean, the spread of what it is of (by the squares of the weights), and how many
/// samples of one weight would tell as much.
Pixel by_hand(const ReconstructionFilter& filter, const std::vector<Sample>& all, double x,
              double y, std::size_t color) {
    double sum = 0, squares = 0, value = 0, spread = 0;
    auto weight = [&](const Sample& s) {
        return filter_value(filter, std::fabs(s.x - x)) * filter_value(filter, std::fabs(s.y - y));
    };
    for (const Sample& s : all)
        sum += weight(s), squares += weight(s) * weight(s), value += weight(s) * s.radiance[color];
    for (const Sample& s : all)
        spread += std::pow(weight(s) * (s.radiance[color] - value / sum), 2);
    double count = sum * sum / squares;
    return {value / sum, spread / squares * count / (count - 1), count};
}

} // namespace

TEST_CASE("Splat truths: means, variances and numbers of samples are those of the samples by hand",
          "[truths]") {
    for (FilterKind kind : {FilterKind::tent, FilterKind::gaussian, FilterKind::mitchell}) {
        Scene scene = splatted_scene(kind);
        REQUIRE(filter_reach(scene.film) > 0);
        std::vector<Sample> all = single_samples(scene);
        Image image = host_image(scene);
        for (std::size_t i = 0; i < image.pixel_count(); i++)
            for (std::size_t color = 0; color < 3; color++) {
                auto column = int(i) % width, row = int(i) / width;
                double x = column + .5, y = row + .5;
                Pixel p = by_hand(scene.film.filter, all, x, y, color);
                std::string name(1, "RGB"[color]);
                CAPTURE(int(kind), i, name);
                double scale = std::fabs(p.mean) + std::sqrt(p.variance);
                CHECK(value_at(image, name, i) == Approx(p.mean).margin(1e-4 * scale));
                CHECK(value_at(image, "variance." + name, i) ==
                      Approx(p.variance).margin(2e-4 * scale * scale));
                CHECK(value_at(image, "samples.N", i) == Approx(p.count).epsilon(1e-4));
            }
    }
}
