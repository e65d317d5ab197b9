// Where a scene is, how large and how turned: the same bits of a scene scaled by a power of two or
// moved, the same means for any other similarity.
#include "host/catalogue/rows.h"

#include "host/catalogue/row_images.h"
#include "host/numerics/placed_scene.h"

#include <glm/gtc/matrix_transform.hpp>

#include "host/catalogue/welch.h"

namespace parhelion::stress {
namespace {

std::string text_of(const Placement& t) {
    return fmt::format("scale {:a}, moved by ({:.9g}, {:.9g}, {:.9g})", t.scale, t.move.x, t.move.y,
                       t.move.z);
}

struct Kind {
    std::string name;
    std::vector<Placement> placements;
};

/// Those of a quick run are all there are.
std::vector<Kind> exact_placements(int step) {
    std::vector<Placement> scales;
    for (int k = -40; k <= 40; k += step)
        scales.push_back({std::exp2(k)});
    return {{"scaled by 2^k, k from -40 to 40", scales},
            {"moved by what its coordinates can be added to exactly",
             {{1, {1, -2, 3}}, {1, {1e9, -1e9, 0.25}}, {1, {0, 0, 1e6}}, {1, {-123456, 65, 1e9}}}},
            {"scaled and moved", {{0x1p-10, {-123456, 65, 0x1p-20}}, {0x1p7, {1e9, -0.5, 4096}}}}};
}

} // namespace

Checks row_scale_and_move(StressRun& run) {
    Scene scene = movable_scene();
    Check bad = bad_samples_check("scaled and moved images");
    Image reference = image_of(run, scene, bad);
    Checks checks;
    for (const Kind& kind : exact_placements(static_cast<int>(run.count(8, 1, 1)))) {
        Check check = same_bits_check(kind.name);
        for (const Placement& t : kind.placements)
            add_images(check, reference, image_of(run, placed(scene, t), bad), text_of(t));
        checks.push_back(check);
        run.done(static_cast<double>(checks.size()) / 3);
    }
    checks.push_back(bad);
    return checks;
}

Checks row_scale_and_turn(StressRun& run) {
    Scene scene = movable_scene();
    scene.sampler.pattern = SamplePattern::independent;
    scene.sampler.samples_per_pixel = 128;
    glm::dmat3 turn(glm::rotate(glm::dmat4(1.0), 1.1, glm::normalize(glm::dvec3(0.3, -0.8, 0.5))));
    const std::pair<const char*, Placement> placements[] = {
        {"scaled by 3.7", {3.7}},
        {"turned", {1, {}, turn}},
        {"scaled, turned and moved", {0.0023, {17.3, -5.1, 0.7}, turn}}};
    WelchTest test{.groups = static_cast<int>(run.count(3, 8, 125)),
                   .of_tests = std::size(placements),
                   .most_error = 0.01};
    Check bad = bad_samples_check("turned images");
    auto mean_of = [&](Scene s, std::uint32_t seed) {
        s.sampler.seed = seed;
        return mean_rgb(image_of(run, s, bad));
    };
    Checks checks;
    for (const auto& [name, t] : placements) {
        Scene other = placed(scene, t);
        test.name = name;
        Checks more = welch_checks(
            run, test, [&](std::uint32_t seed) { return mean_of(scene, seed); },
            [&](std::uint32_t seed) { return mean_of(other, seed); });
        checks.insert(checks.end(), more.begin(), more.end());
    }
    checks.push_back(bad);
    return checks;
}

} // namespace parhelion::stress
