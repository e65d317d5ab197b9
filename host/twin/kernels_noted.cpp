// The shade kernel as C++ with a listener (kernels/device/notes.h), for a path to be told vertex by
// vertex.
#include "host/twin/run_stage.h"
#include "host/twin/shade_notes.h"
#include "host/twin/work_item.h"

#include "host/twin/opencl_names.h"

namespace parhelion {
namespace {

struct Kernels : WorkItem {
    ShadeNotes notes{};

#define PARHELION_REAL float
#define NOTE(event, value) note_##event(value)
#include "kernels/shade.cl"

    static Triple triple(vec3 v) { return {v.x, v.y, v.z}; }

    void note_surface(const SurfaceInteraction& s) {
        ShadingFrame f = surface_frame(s);
        notes.surface = {
            triple(s.p), triple(s.ng), triple(s.ns), {triple(f.s), triple(f.t), triple(f.n)}};
    }
    void note_material(int row) { notes.material = row; }
    void note_emission(const EmitterHit& e) { notes.emission = {triple(e.radiance), e.pdf}; }
    void note_sky(vec3 radiance) { notes.emission = {triple(radiance), 0.f}; }
    void note_sky_pdf(Real pdf) { notes.emission->pdf = pdf; }
    void note_energy_gain(vec3 gain) { notes.energy_gain = triple(gain); }
    void note_emission_weight(Real weight) { notes.emission_weight = weight; }
    void note_pick(const LightPick& p) { notes.pick = {p.row, p.pmf}; }
    void note_light(const EmitterSample& e) {
        notes.light = {triple(e.wi), triple(e.weight), e.inverse_pdf, triple(e.q), e.distant};
    }
    void note_towards_light(const BsdfEval& e) { notes.towards_light = {triple(e.f), e.pdf}; }
    void note_light_weight(Real weight) { notes.light_weight = weight; }
    void note_light_share(Real share) { notes.light_share = share; }
    void note_scattered(const BsdfSample& b) {
        notes.scattered = {triple(b.wi), triple(b.weight), b.pdf, b.eta};
    }
    void note_scattered_share(Real share) { notes.scattered_share = share; }
    void note_roulette(const Roulette& r) { notes.roulette = {r.alive, r.scale}; }
#define DRAW_NAME(name) #name,
    static constexpr const char* draw_names[] = {BOUNCE_DRAWS(DRAW_NAME)};
#undef DRAW_NAME
    void note_draw(BounceDraw draw, const Random4& r) {
        notes.draws.push_back({draw_names[draw], {r.x, r.y, r.z, r.w}});
    }
    void note_emitter_draw(const Random4& r) { note_draw(draw_emitter, r); }
    void note_lobe_draw(const Random4& r) { note_draw(draw_lobe, r); }
    void note_bsdf_draw(const Random4& r) { note_draw(draw_bsdf, r); }
#undef NOTE
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

#include "host/twin/opencl_names_end.h"
