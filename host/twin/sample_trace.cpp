// One sample of an image, vertex by vertex: a pool of one path, looked at between the stages.
#include "host/twin/sample_trace.h"

#include "host/waves/render_params.h"

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

/// The pool's only path.
class OnePath {
public:
    OnePath(const HostLaunch<float>& launch) : launch_(launch) {}

    void run(Stage stage, int depth) { run_work_item(stage, launch_, depth, 0); }
    ShadeNotes shade(int depth) { return shade_noted(launch_, depth); }
    bool lives() const { return launch_.memory.counts[0] > 0; }
    bool has_shadow_ray() const { return launch_.memory.counts[1] > 0; }

    float path(PathWord f) const { return state(launch_.memory.path_state, f); }
    float shadow(ShadowWord f) const { return state(launch_.memory.shadow_state, f); }
    Triple path3(PathWord f) const { return triple(launch_.memory.path_state, f); }
    Triple shadow3(ShadowWord f) const { return triple(launch_.memory.shadow_state, f); }
    int path_int(PathWord f) const { return std::bit_cast<int>(path(f)); }
    int shadow_int(ShadowWord f) const { return std::bit_cast<int>(shadow(f)); }
    /// Of the sample, which is the first of its block.
    float result(int channel) const {
        return launch_.memory
            .results[static_cast<std::size_t>(channel) * launch_.params.result_stride];
    }
    Triple radiance() const { return {result(result_r), result(result_g), result(result_b)}; }

private:
    float state(const std::vector<float>& s, int field) const {
        return s[static_cast<std::size_t>(field) * launch_.params.state_stride];
    }
    Triple triple(const std::vector<float>& s, int field) const {
        return {state(s, field), state(s, field + 1), state(s, field + 2)};
    }

    const HostLaunch<float>& launch_;
};

void read_ray(const OnePath& path, TraceVertex& v) {
    v.origin = path.path3(path_origin), v.direction = path.path3(path_direction);
    v.throughput = path.path3(path_throughput);
}

void read_hit(const OnePath& path, const DeviceScene& scene, TraceVertex& v) {
    int number = path.path_int(path_primitive);
    v.hit = number >= 0;
    if (!v.hit) return;
    const PrimitiveRecord& p = scene.primitives[static_cast<std::size_t>(number)];
    v.t = path.path(path_t);
    v.shape = p.shape, v.primitive = p.index_in_shape;
}

void read_material(const DeviceScene& scene, int number, TraceVertex& v) {
    const auto& frame = v.notes.surface->frame;
    for (int axis = 0; axis < 3; axis++)
        v.wo[axis] = -dot(v.direction, frame[axis]);
    const PrimitiveRecord& p = scene.primitives[static_cast<std::size_t>(number)];
    bool back = v.wo[2] < 0.f && (scene.features.has(feature_back_materials));
    v.material = back ? p.material_back : p.material_front;
}

/// What next event estimation brings where it has cast no ray: as the kernel computes it.
Triple unsent_light(const TraceVertex& v) {
    const ShadeNotes& n = v.notes;
    if (!n.light || !n.towards_light) return {};
    float weight = n.light_weight.value_or(1.f) * n.light_share.value_or(1.f);
    return times(times(times(v.throughput, n.towards_light->f), n.light->weight), weight);
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

/// One bounce; whether the path goes on.
bool trace_vertex(OnePath& path, const DeviceScene& scene, bool last, TraceVertex& v) {
    read_ray(path, v);
    path.run(Stage::intersect, v.bounce);
    read_hit(path, scene, v);
    int number = path.path_int(path_primitive);
    Triple before = path.radiance();
    v.notes = path.shade(v.bounce);
    v.emission = minus(path.radiance(), before);
    if (v.hit) read_material(scene, number, v);
    if (!last && v.hit) {
        v.light = unsent_light(v);
        v.shadow_ray = path.has_shadow_ray();
        v.goes_on = path.lives();
        if (v.goes_on) v.throughput_after = path.path3(path_throughput);
    }
    if (v.shadow_ray) {
        v.light = path.shadow3(shadow_contribution);
        path.run(Stage::shadow, v.bounce);
        v.blocked = path.shadow_int(shadow_blocked) != 0;
    }
    find_not_finite(v);
    return v.goes_on;
}

/// What the film gets.
void add_up(OnePath& path, const WaveMemory<float>& memory, SampleTrace& trace) {
    trace.radiance = path.radiance();
    trace.alpha = path.result(result_alpha), trace.weight = path.result(result_weight);
    path.run(Stage::accumulate, 0);
    for (const BadSample& bad : first_bad_samples({memory.bad_samples}))
        trace.left_out = bad;
    // The place of its alpha says what went wrong.
    if (std::isnan(trace.weight)) trace.alpha = trace.weight;
}

} // namespace

SampleTrace trace_sample(const Scene& scene, const DeviceScene& flat, int x, int y, int sample) {
    AovPlan aovs = plan_aovs(scene);
    WorkSizes sizes = sizes_of_one(scene, aovs, x, y);
    WaveMemory<float> memory(sizes);
    // Streams store whether a shadow ray was blocked; their answers are those of packets.
    HostLaunch<float> launch{scene_arrays(flat), render_params(scene, flat, sizes, aovs),
                             flat.features.on() | FeatureSet{feature_ray_streams},
                             WaveParams{0, 1, sample, 1}, memory};
    OnePath path(launch);
    path.run(Stage::generate, 0);
    SampleTrace trace;
    trace.x = x, trace.y = y, trace.sample = sample;
    trace.on_film = path.lives();
    float pdf = std::numeric_limits<float>::infinity();
    for (bool alive = trace.on_film; alive;) {
        TraceVertex& v = trace.vertices.emplace_back();
        v.pdf = pdf;
        v.bounce = static_cast<int>(trace.vertices.size()) - 1;
        bool last = v.bounce + 1 == launch.params.max_depth;
        alive = trace_vertex(path, flat, last, v);
        if (v.notes.scattered) pdf = v.notes.scattered->pdf;
        if (!v.not_finite.empty() && trace.first_not_finite < 0) trace.first_not_finite = v.bounce;
    }
    add_up(path, memory, trace);
    return trace;
}

} // namespace parhelion
