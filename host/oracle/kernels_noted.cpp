// The shade kernel as C++ with its calls listened to, for a path to be told vertex by vertex.
//
// The kernel's text is the one that renders; while it is read here, the names of the functions that
// it calls stand for the call and a note of the answer.
#include "host/oracle/run_stage.h"
#include "host/oracle/shade_notes.h"
#include "host/oracle/work_item.h"

#include "host/oracle/opencl_names.h"

namespace parhelion {
namespace {

struct Kernels : WorkItem {
    ShadeNotes notes{};

#define PARHELION_REAL float
// What shade.cl includes: it may not see the macros below.
#include "device/device.h"
#include "device/lanes_memory.h"
#include "device/light_table.h"
#include "device/path_state.h"
#include "device/path_vertex.h"

    static Triple triple(vec3 v) { return {v.x, v.y, v.z}; }

    const SurfaceInteraction& note(const SurfaceInteraction& s) {
        ShadingFrame f = surface_frame(s);
        notes.surface = {
            triple(s.p), triple(s.ng), triple(s.ns), {triple(f.s), triple(f.t), triple(f.n)}};
        return s;
    }
    EmitterHit note(const EmitterHit& e) {
        notes.emission = {triple(e.radiance), e.pdf};
        return e;
    }
    vec3 note_sky(vec3 radiance) {
        notes.emission = {triple(radiance), 0.f};
        return radiance;
    }
    LightPick note(const LightPick& p) {
        notes.pick = {p.row, p.pmf};
        return p;
    }
    EmitterSample note(const EmitterSample& e) {
        notes.light = {triple(e.wi), triple(e.weight), e.inverse_pdf, triple(e.q), e.distant};
        return e;
    }
    BsdfEval note(const BsdfEval& e) {
        notes.towards_light = {triple(e.f), e.pdf};
        return e;
    }
    BsdfSample note(const BsdfSample& b) {
        notes.scattered = {triple(b.wi), triple(b.weight), b.pdf, b.eta};
        return b;
    }
    Roulette note(const Roulette& r) {
        notes.roulette = {r.alive, r.scale};
        return r;
    }
    /// Asked for the direction to the light, then for the one to go on in.
    Real note_share(Real share) {
        (notes.scattered ? notes.scattered_share : notes.light_share) = share;
        return share;
    }
    static Real note_weight(Real weight, std::optional<float>& to) {
        to = weight;
        return weight;
    }
    Random4 note_draw(SampleNumber number, Uint set) {
        Random4 r = sampler_draw(number, set);
        notes.draws.push_back({set, {r.x, r.y, r.z, r.w}});
        return r;
    }

#define surface_frame(s) surface_frame(note(s))
#define emitter_hit(...) note(emitter_hit(__VA_ARGS__))
#define light_radiance(light) note_sky(light_radiance(light))
#define power_heuristic(...) note_weight(power_heuristic(__VA_ARGS__), notes.emission_weight)
#define pick_light(...) note(pick_light(__VA_ARGS__))
#define emitter_sample(...) note(emitter_sample(__VA_ARGS__))
#define bsdf_eval(...) note(bsdf_eval(__VA_ARGS__))
#define power_heuristic_inverse(...)                                                               \
    note_weight(power_heuristic_inverse(__VA_ARGS__), notes.light_weight)
#define counted_share(...) note_share(counted_share(__VA_ARGS__))
#define bsdf_sample(...) note(bsdf_sample(__VA_ARGS__))
#define russian_roulette(...) note(russian_roulette(__VA_ARGS__))
#define sampler_draw(...) note_draw(__VA_ARGS__)
#include "kernels/shade.cl"
#undef PARHELION_REAL
};

} // namespace

ShadeNotes shade_noted(const HostLaunch<float>& launch, int depth) {
    auto buffers = buffer_ranges(launch);
    Kernels kernels{{launch.features, 0, buffers}};
#define SCENE_ARGUMENT(type, name) launch.scene.name.data(),
#define WORK_ARGUMENT(type, name) launch.memory.name.data(),
    kernels.shade(SCENE_BUFFERS(SCENE_ARGUMENT) WORK_BUFFERS(WORK_ARGUMENT) launch.params,
                  launch.wave, depth);
    return std::move(kernels.notes);
}

} // namespace parhelion

#include "host/oracle/opencl_names_end.h"
