// Many lights: choosing by what they send to a point changes the noise and not the image.
#include "host/numerics/statistics.h"
#include "tests/support/many_lights_scene.h"
#include "tests/support/render_scene.h"

#include <catch2/catch.hpp>
#include <fmt/format.h>

using namespace parhelion;
using namespace parhelion::numerics;
using namespace parhelion::test;

namespace {

struct Estimate {
    std::array<Mean, 3> channels;
    double squared_noise = 0; ///< mean square of the difference of two neighbouring seeds
};

Estimate estimate(Scene scene, LightChoice choice, int seeds) {
    Estimate e;
    RenderOptions options;
    options.light_choice = choice;
    std::vector<float> before;
    for (int seed = 0; seed < seeds; seed++) {
        scene.sampler.seed = static_cast<std::uint32_t>(100 + seed);
        RenderResult result = render_quietly(scene, options);
        CHECK(result.report.non_finite_samples == 0);
        std::array<double, 3> mean = mean_rgb(result.image);
        for (std::size_t c = 0; c < 3; c++)
            e.channels[c].add(mean[c]);
        const std::vector<float>& now = find_channel(result.image, "G")->values;
        for (std::size_t i = 0; i < before.size(); i++)
            e.squared_noise += (now[i] - before[i]) * double(now[i] - before[i]);
        before = now;
    }
    return e;
}

} // namespace

TEST_CASE("The light tree gives the mean of choosing by power, with less noise") {
    for (int count : {2, 8, 100, 2000})
        for (bool mixed : {false, true}) {
            Scene scene = many_lights_scene(count, mixed);
            scene.sampler.pattern = SamplePattern::independent;
            Estimate tree = estimate(scene, LightChoice::importance, 16),
                     power = estimate(scene, LightChoice::power, 16);
            double ratio = tree.squared_noise / power.squared_noise;
            fmt::print("{} lights{}: variance {:.3f} of that by power\n", count,
                       mixed ? " of every kind" : "", ratio);
            CAPTURE(count, mixed, ratio);
            CHECK(ratio < (count > 50 ? 0.8 : 1.1));
            for (std::size_t c = 0; c < 3; c++) {
                double error = std::hypot(tree.channels[c].error(), power.channels[c].error());
                double z = (tree.channels[c].mean() - power.channels[c].mean()) / error;
                CAPTURE(c, tree.channels[c].mean(), power.channels[c].mean(), z);
                CHECK(student_two_sided(z, 15) > sidak_level(0.01, 24));
            }
        }
}
