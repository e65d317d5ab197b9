// The kernels as C++, in small: what the sanitizers see of them. That their images are the device's
// is for tests/render.
#include "host/numerics/every_kind_scene.h"
#include "host/twin/sample_trace.h"
#include "tests/support/host_render.h"

#include <catch2/catch.hpp>
#include <tbb/global_control.h>

#include <cmath>

using namespace parhelion;
using namespace parhelion::test;
using namespace parhelion::numerics;

namespace {

Scene small_scene() {
    Scene scene = every_kind_scene();
    scene.film.width = scene.film.crop_width = 13;
    scene.film.height = scene.film.crop_height = 9;
    scene.sampler.samples_per_pixel = 3;
    return scene;
}

bool same_values(const Image& a, const Image& b) {
    bool same = a.channels.size() == b.channels.size();
    for (std::size_t c = 0; same && c < a.channels.size(); c++)
        same = a.channels[c].values == b.channels[c].values;
    return same;
}

} // namespace

TEST_CASE("Host kernels: the image does not depend on how the work is split", "[host kernels]") {
    Scene scene = small_scene();
    RenderOptions split, streams;
    split.split = {200, 7, 3};
    streams.all_features = true; // with streams of rays
    for (Precision precision : {Precision::single_precision, Precision::double_precision}) {
        RenderResult whole = host_render(scene, precision);
        CHECK(whole.report.non_finite_samples == 0);
        CHECK(whole.report.shadow_rays > 100);
        CHECK(same_values(whole.image, host_render(scene, precision, split).image));
        CHECK(same_values(whole.image, host_render(scene, precision, streams).image));
        tbb::global_control one_thread(tbb::global_control::max_allowed_parallelism, 1);
        CHECK(same_values(whole.image, host_render(scene, precision).image));
    }
}

TEST_CASE("Host kernels: samples placed by the filter, without a pattern", "[host kernels]") {
    Scene scene = small_scene();
    scene.film.filter_method = FilterMethod::sampling;
    scene.sampler.pattern = SamplePattern::independent;
    Image single = host_render(scene, Precision::single_precision).image;
    Image twice = host_render(scene, Precision::double_precision).image;
    int apart = 0;
    const auto& a = find_channel(single, "G")->values;
    const auto& b = find_channel(twice, "G")->values;
    for (std::size_t i = 0; i < a.size(); i++)
        apart += !(std::abs(a[i] - b[i]) < 1e-3f);
    CHECK(apart < 6);
}

TEST_CASE("Host kernels: a sample is traced", "[host kernels]") {
    Scene scene = small_scene();
    DeviceScene flat = make_device_scene(scene);
    std::size_t vertices = 0;
    for (int y = 0; y < 9; y++)
        for (int x = 0; x < 13; x++)
            vertices += trace_sample(scene, flat, x, y, 1).vertices.size();
    CHECK(vertices > 200);
}
