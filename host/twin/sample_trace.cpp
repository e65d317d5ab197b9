// One sample of an image, vertex by vertex: a pool of one path, looked at between the stages.
#include "host/twin/sample_trace.h"

#include "host/waves/render_params.h"
#include "host/waves/wavefront.h"

#include <bit>
#include <cmath>
#include <limits>

namespace parhelion {
namespace {

/// A window of one pixel and a wave of one sample of it.
WorkSizes sizes_of_one(const Scene& scene, const AovPlan& aovs, int x, int y) {
    WorkSizes s;
    s.film = film_layout(scene, aovs);
    SampleWindow& window = s.film.window;
    window.x = window.block_x = x, window.y = window.block_y = y;
    window.width = window.height = window.blocks_x = window.blocks_y = 1;
    s.segment_stride = s.segment_size;
    return s;
}

bool finite(const Triple& v) {
    return std::isfinite(v[0]) && std::isfinite(v[1]) && std::isfinite(v[2]);
}

Triple times(const Triple& a, const Triple& b) { return {a[0] * b[0], a[1] * b[1], a[2] * b[2]}; }
Triple times(const Triple& a, float s) { return {a[0] * s, a[1] * s, a[2] * s}; }
Triple minus(const Triple& a, const Triple& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
float dot(const Triple& a, const Triple& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

/// The pool's only path, as it lies in the buffers.
class OnePath {
public:
    OnePath(const WaveMemory<float>& memory, const RenderParams& params)
        : memory_(memory), params_(params) {}

    bool lives() const { return memory_.counts[0] > 0; }
    bool has_shadow_ray() const { return memory_.counts[1] > 0; }

    float path(PathWord f) const { return state(memory_.path_state, f); }
    Triple path3(PathWord f) const { return triple(memory_.path_state, f); }
    Triple shadow3(ShadowWord f) const { return triple(memory_.shadow_state, f); }
    int path_int(PathWord f) const { return std::bit_cast<int>(path(f)); }
    int shadow_int(ShadowWord f) const {
        return std::bit_cast<int>(state(memory_.shadow_state, f));
    }
    /// Of the sample, which is the first of its block.
    float result(int channel) const {
        return memory_.results[static_cast<std::size_t>(channel) * params_.result_stride];
    }
    Triple radiance() const { return {result(result_r), result(result_g), result(result_b)}; }

private:
    float state(const std::vector<float>& s, int field) const {
        return s[static_cast<std::size_t>(field) * params_.state_stride];
    }
    Triple triple(const std::vector<float>& s, int field) const {
        return {state(s, field), state(s, field + 1), state(s, field + 2)};
    }

    const WaveMemory<float>& memory_;
    const RenderParams& params_;
};

void read_ray(const OnePath& path, TraceVertex& v) {
    v.origin = path.path3(path_origin), v.direction = path.path3(path_direction);
    v.throughput = path.path3(path_throughput);
}

void read_hit(const OnePath& path, const DeviceScene& scene, TraceVertex& v) {
    int number = path.path_int(path_primitive);
    v.hit = number >= 0;
    if (!v.hit) return;
    v.t = path.path(path_t);
    v.shape = scene.geometry.shape_of(number);
    v.primitive = scene.geometry.index_in_shape(number);
}

void read_material(TraceVertex& v) {
    const auto& frame = v.notes.surface->frame;
    for (int axis = 0; axis < 3; axis++)
        v.wo[axis] = -dot(v.direction, frame[axis]);
    v.material = *v.notes.material;
}

/// What next event estimation brings where it has cast no ray: as the kernel computes it.
Triple unsent_light(const TraceVertex& v) {
    const ShadeNotes& n = v.notes;
    if (!n.light || !n.towards_light) return {};
    float weight = n.light_weight.value_or(1.f) * n.light_share.value_or(1.f);
    Triple throughput = times(v.throughput, n.energy_gain.value_or(Triple{1, 1, 1}));
    return times(times(times(throughput, n.towards_light->f), n.light->weight), weight);
}

/// Names what is not finite, but for densities: those of delta lobes are infinite.
void find_not_finite(TraceVertex& v) {
    auto check = [&](const char* name, bool good) {
        if (!good) v.not_finite.emplace_back(name);
    };
    check("origin", finite(v.origin));
    check("direction", finite(v.direction));
    check("throughput", finite(v.throughput));
    check("emission", finite(v.emission));
    if (!v.hit) return;
    check("t", std::isfinite(v.t));
    check("position", finite(v.notes.surface->position));
    check("ng", finite(v.notes.surface->ng));
    check("ns", finite(v.notes.surface->ns));
    if (v.material < 0) return;
    check("light", finite(v.light));
    if (!v.notes.scattered) return;
    check("bsdf weight", finite(v.notes.scattered->weight));
    // A path whose throughput is not finite has ended.
    check("throughput after",
          finite(v.goes_on ? v.throughput_after : times(v.throughput, v.notes.scattered->weight)));
}

/// A WaveDevice for one sample: runs the stages as the host does, and looks at the path in between.
class TracedWave {
public:
    TracedWave(const HostLaunch<float>& launch, const DeviceScene& scene)
        : launch_(launch), path_(launch.memory, launch_.params), scene_(scene) {}

    void begin_wave(const Wave& wave) { set_wave(launch_, wave); }
    void launch(Stage stage, int depth, int) {
        switch (stage) {
        case Stage::generate:
            run(stage, depth);
            trace_.on_film = path_.lives();
            break;
        case Stage::intersect:
            if (path_.lives()) begin_vertex(depth);
            break;
        case Stage::shade:
            if (path_.lives()) shade(trace_.vertices.back());
            break;
        case Stage::shadow:
            run(stage, depth);
            trace_.vertices.back().blocked = path_.shadow_int(shadow_blocked) != 0;
            trace_.vertices.back().arriving = path_.shadow3(shadow_contribution);
            break;
        case Stage::accumulate:
            add_up();
        }
    }
    std::span<const int> read_counts() const { return launch_.memory.counts; }
    double end_wave() { return 0; }

    SampleTrace take() { return std::move(trace_); }

private:
    void run(Stage stage, int depth) { run_work_item(stage, launch_, depth, 0); }
    void begin_vertex(int depth);
    /// Where there is no surface, and light that was sampled before goes through.
    bool goes_on_as_it_was(const TraceVertex& v) const {
        return launch_.features.has(feature_clear_shadows) && v.material >= 0 &&
               scene_.materials[static_cast<std::size_t>(v.material)].kind == material_null;
    }
    void shade(TraceVertex& v);
    void add_up();

    HostLaunch<float> launch_;
    OnePath path_;
    const DeviceScene& scene_;
    SampleTrace trace_;
    float pdf_ = std::numeric_limits<float>::infinity(); ///< of the next vertex's direction
};

/// Where the ray comes from and what it hits.
void TracedWave::begin_vertex(int depth) {
    TraceVertex& v = trace_.vertices.emplace_back();
    v.bounce = depth;
    v.pdf = pdf_;
    read_ray(path_, v);
    run(Stage::intersect, depth);
    read_hit(path_, scene_, v);
}

void TracedWave::shade(TraceVertex& v) {
    Triple before = path_.radiance();
    v.notes = shade_noted(launch_, v.bounce);
    v.emission = minus(path_.radiance(), before);
    if (v.hit) {
        read_material(v);
        v.shadow_ray = path_.has_shadow_ray();
        v.light = v.shadow_ray ? path_.shadow3(shadow_contribution) : unsent_light(v);
        v.goes_on = path_.lives();
        if (v.goes_on) v.throughput_after = path_.path3(path_throughput);
    }
    if (v.notes.scattered && !goes_on_as_it_was(v)) pdf_ = v.notes.scattered->pdf;
    find_not_finite(v);
    if (!v.not_finite.empty() && trace_.first_not_finite < 0) trace_.first_not_finite = v.bounce;
}

/// What the film gets.
void TracedWave::add_up() {
    trace_.radiance = path_.radiance();
    trace_.alpha = path_.result(result_alpha), trace_.weight = path_.result(result_weight);
    run(Stage::accumulate, 0);
    for (const BadSample& bad : first_bad_samples({launch_.memory.bad_samples}))
        trace_.left_out = bad;
    // The place of its alpha says what went wrong.
    if (std::isnan(trace_.weight)) trace_.alpha = trace_.weight;
}

} // namespace

SampleTrace trace_sample(const Scene& scene, const DeviceScene& flat, int x, int y, int sample) {
    AovPlan aovs = plan_aovs(scene);
    WorkSizes sizes = sizes_of_one(scene, aovs, x, y);
    WaveMemory<float> memory(sizes);
    RenderParams params = render_params(scene, flat, sizes, aovs);
    // Streams store whether a shadow ray was blocked; their answers are those of packets.
    FeatureSet features = flat.features.on() | FeatureSet{feature_ray_streams};
    TracedWave device({scene_arrays(flat), params, features, WaveParams{}, memory}, flat);
    trace_wave(device, Wave{{{0, 1, sample, sample + 1}}}, wave_loop(sizes, params, features));
    SampleTrace trace = device.take();
    trace.x = x, trace.y = y, trace.sample = sample;
    return trace;
}

} // namespace parhelion
