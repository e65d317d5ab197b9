// Reconstruction filters: an edge seen through a filter has the filter's integral as its profile.
#include "host/flatten/camera_record.h"
#include "host/flatten/filter_table.h"
#include "host/numerics/every_kind_scene.h"
#include "host/numerics/statistics.h"
#include "tests/support/render_scene.h"

#include <catch2/catch.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace {

using namespace parhelion;
using namespace parhelion::numerics;

constexpr int width = 18, height = 6, seeds = 8;
constexpr double edge = 8.3; // pixels from the left of the film
constexpr double family_level = 0.01;
// A mean of weighted samples over the sum of their weights is off by a share of 1 / samples.
constexpr double ratio_bias = 2e-4;

struct Setting {
    ReconstructionFilter filter;
    FilterMethod method;
    bool sample_border;
};

ReconstructionFilter filter_of(FilterKind kind, double radius = 0.0, double stddev = 0.5) {
    ReconstructionFilter filter;
    filter.kind = kind, filter.radius = radius, filter.stddev = stddev;
    return filter;
}

std::vector<Setting> settings() {
    std::vector<Setting> all;
    for (FilterMethod method : {FilterMethod::splatting, FilterMethod::sampling})
        for (bool border : {false, true})
            for (const ReconstructionFilter& filter :
                 {filter_of(FilterKind::box), filter_of(FilterKind::tent),
                  filter_of(FilterKind::tent, 0.4), filter_of(FilterKind::gaussian),
                  filter_of(FilterKind::gaussian, 0, 1.0), filter_of(FilterKind::gaussian, 0, 1.4),
                  filter_of(FilterKind::mitchell), filter_of(FilterKind::catmullrom),
                  filter_of(FilterKind::lanczos)})
                all.push_back({filter, method, border});
    return all;
}

/// A light of radiance 1 left of the edge, nothing right of it.
Scene edge_scene(const Setting& setting) {
    Scene scene;
    scene.file = "made by the test";
    scene.materials.push_back({"", {}, DiffuseBsdf{Rgb(0)}});
    scene.film.width = scene.film.crop_width = width;
    scene.film.height = scene.film.crop_height = height;
    scene.film.filter = setting.filter;
    scene.film.filter_method = setting.method;
    scene.film.sample_border = setting.sample_border;
    scene.sampler.samples_per_pixel = 400;
    CameraRecord c = camera_record(scene.camera, width, height, {});
    glm::dvec3 origin(c.ox, c.oy, c.oz), corner(c.dx, c.dy, c.dz), step_x(c.ux, c.uy, c.uz),
        step_y(c.vx, c.vy, c.vz);
    constexpr double margin = 20, distance = 3; // pixels beyond the film, metres
    Mesh light = numerics::quad(origin + distance * (corner - margin * (step_x + step_y)),
                                distance * (height + 2 * margin) * step_y,
                                distance * (edge + margin) * step_x);
    scene.shapes.push_back(numerics::shape_of(light, 0, 0, Rgb(1)));
    return scene;
}

/// Integral of the filter over film positions from a to b, its centre at c.
double filter_integral(const ReconstructionFilter& filter, double a, double b, double c) {
    constexpr int cells = 20000;
    double sum = 0, radius = filter_radius(filter);
    a = std::max(a - c, -radius), b = std::min(b - c, radius);
    if (a >= b) return 0;
    for (int i = 0; i < cells; i++)
        sum += filter_value(filter, a + (b - a) * (i + 0.5) / cells);
    return sum * (b - a) / cells;
}

double profile(const Setting& setting, int column) {
    double far = setting.sample_border ? 100 : 0, centre = column + 0.5;
    return filter_integral(setting.filter, -far, edge, centre) /
           filter_integral(setting.filter, -far, width + far, centre);
}

} // namespace

TEST_CASE("An edge has the profile of the filter's integral, however the filter is applied",
          "[render]") {
    std::vector<Setting> all = settings();
    double level = numerics::sidak_level(family_level, all.size() * width);
    for (const Setting& setting : all) {
        Scene scene = edge_scene(setting);
        std::vector<numerics::Mean> columns(width);
        for (int seed = 0; seed < seeds; seed++) {
            scene.sampler.seed = seed;
            Image image = test::render_quietly(scene).image;
            for (int x = 0; x < width; x++) {
                double sum = 0;
                for (int y = 0; y < height; y++)
                    sum += find_channel(image, "R")->values[image.index(x, y)];
                columns[x].add(sum / height);
            }
        }
        double worst = 0;
        for (int x = 0; x < width; x++) {
            double truth = profile(setting, x), off = std::abs(columns[x].mean() - truth);
            worst = std::max(worst, off);
            double error = std::hypot(columns[x].error(), 1e-6);
            INFO(fmt::format(
                "filter {} method {} border {} column {}: {:.6f} truth {:.6f} +- {:.1e}",
                int(setting.filter.kind), int(setting.method), setting.sample_border, x,
                columns[x].mean(), truth, error));
            CHECK(numerics::student_two_sided(std::max(0.0, off - ratio_bias) / error, seeds - 1) >
                  level);
            CHECK(error < 4e-3);
        }
        fmt::print("filter {} method {} border {}: off by {:.1e} at most\n",
                   int(setting.filter.kind), int(setting.method), setting.sample_border, worst);
    }
}

TEST_CASE("Splatting leaves less noise than sampling the filter", "[render]") {
    Scene scene = numerics::every_kind_scene();
    scene.integrator.aovs.clear();
    scene.sampler.samples_per_pixel = 16;
    auto variance = [&](FilterMethod method) {
        scene.film.filter_method = method;
        std::vector<numerics::Mean> pixels(scene.film.width * scene.film.height);
        for (int seed = 0; seed < 8; seed++) {
            scene.sampler.seed = seed;
            Image image = test::render_quietly(scene).image;
            for (std::size_t i = 0; i < pixels.size(); i++)
                pixels[i].add(find_channel(image, "G")->values[i]);
        }
        double sum = 0;
        for (const numerics::Mean& pixel : pixels)
            sum += pixel.error() * pixel.error();
        return sum / static_cast<double>(pixels.size());
    };
    double ratio = variance(FilterMethod::splatting) / variance(FilterMethod::sampling);
    fmt::print("variance of splatting over that of sampling: {:.3f}\n", ratio);
    CHECK(ratio < 0.7);
}
