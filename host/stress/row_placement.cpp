// Where a scene is, how large and how turned: the same bits of a scene scaled by a power of two or
// moved, the same means for any other similarity.
#include "host/stress/rows.h"

#include "host/render/path_tracer.h"
#include "host/stress/every_kind_scene.h"
#include "host/stress/image_figures.h"
#include "host/stress/placed_scene.h"

#include <glm/gtc/matrix_transform.hpp>

#include "host/stress/welch.h"

namespace parhelion::stress {
namespace {

Scene small_scene() {
    Scene scene = with_coarse_places(every_kind_scene());
    scene.film.width = scene.film.crop_width = scene.film.height = scene.film.crop_height = 16;
    scene.camera.fov_degrees = 90; // some sky beside the walls
    scene.sampler.samples_per_pixel = 8;
    scene.integrator.aovs.clear();
    return scene;
}

Image image_of(StressRun& run, const Scene& scene) {
    Progress quiet(Progress::Mode::quiet);
    return render(scene, run.device, {}, quiet).image;
}

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
    Scene scene = small_scene();
    Image reference = image_of(run, scene);
    Checks checks;
    for (const Kind& kind : exact_placements(static_cast<int>(run.count(8, 1, 1)))) {
        Check check{.name = kind.name + ": values of other bits", .target = 0, .unit = "values"};
        for (const Placement& t : kind.placements) {
            DifferingValues found = differing_values(reference, image_of(run, placed(scene, t)));
            if (found.differing > 0) check.worst_at = text_of(t);
            check.value += static_cast<double>(found.differing);
            check.samples += found.values;
        }
        checks.push_back(check);
        run.done(static_cast<double>(checks.size()) / 3);
    }
    return checks;
}

Checks row_scale_and_turn(StressRun& run) {
    Scene scene = small_scene();
    scene.sampler.pattern = SamplePattern::independent;
    scene.sampler.samples_per_pixel = 32;
    glm::dmat3 turn(glm::rotate(glm::dmat4(1.0), 1.1, glm::normalize(glm::dvec3(0.3, -0.8, 0.5))));
    const std::pair<const char*, Placement> placements[] = {
        {"scaled by 3.7", {3.7}},
        {"turned", {1, {}, turn}},
        {"scaled, turned and moved", {0.0023, {17.3, -5.1, 0.7}, turn}}};
    int groups = static_cast<int>(run.count(2, 8, 125));
    auto mean_of = [&](Scene s, std::uint32_t seed) {
        s.sampler.seed = seed;
        return mean_rgb(image_of(run, s));
    };
    Checks checks;
    for (const auto& [name, t] : placements) {
        Scene other = placed(scene, t);
        Checks more = welch_checks(
            run, name, groups, 6 * std::size(placements),
            [&](std::uint32_t seed) { return mean_of(scene, seed); },
            [&](std::uint32_t seed) { return mean_of(other, seed); });
        checks.insert(checks.end(), more.begin(), more.end());
    }
    return checks;
}

} // namespace parhelion::stress
