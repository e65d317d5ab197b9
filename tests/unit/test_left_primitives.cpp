// A ray that leaves a flat primitive cannot meet it again, whatever rounding says; one that leaves
// a sphere can. What paths and shadow rays are told of that, in both precisions.
#include "host/twin/wave_memory.h"
#include "host/waves/render_params.h"
#include "host/waves/wavefront.h"
#include "tests/support/two_of_every.h"

#include <catch2/catch.hpp>

#include <cstring>
#include <map>
#include <span>
#include <string>
#include <vector>

using namespace parhelion;
using namespace parhelion::test;

namespace {

constexpr int none = -1;

/// A WaveDevice that looks at the states after each shade.
template<class Real>
class Watched {
public:
    Watched(const HostLaunch<Real>& launch, const DeviceScene& scene)
        : launch_(launch), scene_(scene) {}

    void begin_wave(const Wave& wave) { set_wave(launch_, wave); }
    void launch(Stage stage, int depth, int work_items) {
        for (int number = 0; number < work_items; number++)
            run_work_item(stage, launch_, depth, number);
        const auto& paths = launch_.memory.path_state;
        const auto& shadows = launch_.memory.shadow_state;
        if (stage == Stage::generate)
            each(paths, 0, path_slot, path_excluded,
                 [&](int, int left) { camera += left == none; });
        if (stage == Stage::intersect)
            each(paths, 0, path_slot, path_primitive, [&](int slot, int at) { at_[slot] = at; });
        if (stage != Stage::shade) return;
        auto check = [&](const char* of, int slot, int left) {
            CAPTURE(of, slot, depth);
            int at = at_.at(slot);
            bool round = at != none && is_round(at);
            CHECK(left == (round ? none : at));
            (round ? rounds : flat)[of]++;
        };
        each(paths, 0, path_slot, path_excluded,
             [&](int slot, int left) { check("path", slot, left); });
        each(shadows, 1, shadow_slot, shadow_excluded,
             [&](int slot, int left) { check("shadow ray", slot, left); });
    }
    std::span<const int> read_counts() const { return launch_.memory.counts; }
    double end_wave() { return 0; }

    int camera = 0;
    std::map<std::string, int> flat, rounds;

private:
    /// Its other side can be met from it.
    bool is_round(int primitive) const {
        int shape = scene_.geometry.shape_of(primitive);
        int kind = scene_.geometry.shapes[shape].flags & PRIMITIVE_KIND_MASK;
        return kind == geometry_sphere || kind == geometry_cylinder;
    }
    /// An int among Reals takes the first bytes of one.
    int word(const std::vector<Real>& state, int field, int entry) const {
        std::size_t stride = launch_.params.state_stride;
        int value = 0;
        std::memcpy(&value, &state[field * stride + entry], sizeof value);
        return value;
    }
    /// visit(slot, a word) for the live entries of a state; `count`: which of its segments' counts.
    void each(const std::vector<Real>& state, int count, int slot, int of, auto visit) const {
        const std::vector<int>& counts = launch_.memory.counts;
        for (int segment = 0; segment < static_cast<int>(counts.size()) / 2; segment++)
            for (int k = 0; k < counts[2 * segment + count]; k++) {
                int entry = segment * launch_.params.segment_stride + k;
                visit(word(state, slot, entry), word(state, of, entry));
            }
    }

    HostLaunch<Real> launch_;
    const DeviceScene& scene_;
    std::map<int, int> at_; ///< by slot: the primitive that its path is on
};

template<class Real>
void check_rays() {
    Scene scene = two_of_every();
    scene.film.width = scene.film.crop_width = 16;
    set_energy_compensation(scene, false);
    DeviceScene flat = make_device_scene(scene);
    AovPlan aovs = plan_aovs(scene);
    WorkSplit split;
    split.streams = 1, split.segment_paths = 64;
    int samples = scene.sampler.samples_per_pixel;
    WorkSizes sizes = work_sizes(film_layout(scene, aovs), samples, 1, split);
    WaveMemory<Real> memory(sizes);
    RenderParams params = render_params(scene, flat, sizes, aovs);
    FeatureSet features = flat.features.on();
    Watched<Real> device({scene_arrays(flat), params, features, WaveParams{}, memory}, flat);
    trace_wave(device, Wave{{{0, sizes.blocks_per_wave, 0, sizes.samples_per_wave}}},
               wave_loop(sizes, params, features));
    CHECK(device.camera == scene.film.width * scene.film.height * sizes.samples_per_wave);
    for (const char* of : {"path", "shadow ray"}) {
        CHECK(device.flat[of] > 50);
        CHECK(device.rounds[of] > 50);
    }
}

} // namespace

TEST_CASE("Rays do not meet the flat primitive that they leave", "[host kernels]") {
    check_rays<float>();
    check_rays<double>();
}
