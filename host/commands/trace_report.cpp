// What `parhelion render --trace` prints.
#include "host/commands/trace_report.h"
#include "host/film/film_image.h"
#include "host/flatten/kind_names.h"
#include "host/render/report.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>

namespace parhelion {
namespace {

using nlohmann::json;

json triple(const Triple& v) { return {json_number(v[0]), json_number(v[1]), json_number(v[2])}; }
/// Of values of the device, in the scene's unit.
json triple(const Triple& v, double unit) {
    auto scaled = [unit](float x) { return static_cast<float>(x * unit); };
    return triple({scaled(v[0]), scaled(v[1]), scaled(v[2])});
}
json radiance(const SceneFrame& frame, const Triple& v) { return triple(v, frame.radiance_unit); }

/// A point of the device in the scene.
json place(const SceneFrame& frame, const Triple& v) {
    json out = json::array();
    for (int axis = 0; axis < 3; axis++)
        out.push_back(json_number(double{v[axis]} * frame.unit() + frame.centre()[axis]));
    return out;
}

json shape_json(const Scene& scene, int index, int primitive) {
    const Shape& shape = scene.shapes[static_cast<std::size_t>(index)];
    return {{"index", index}, {"id", shape.id}, {"plugin", shape.plugin}, {"primitive", primitive}};
}

json material_json(const Scene& scene, const DeviceScene& flat, int row) {
    if (row < 0) return nullptr;
    auto i = static_cast<std::size_t>(row);
    return {{"index", row},
            {"id", scene.materials[i].id},
            {"kind", material_names[static_cast<std::size_t>(flat.materials[i].kind)]}};
}

/// The shape that shines as a row of the light table; none: an emitter without a surface.
json light_shape(const Scene& scene, const DeviceScene& flat, int row) {
    const auto& primitives = flat.geometry.primitives;
    auto shines = [row](const IndexedPrimitiveRecord& p) { return p.light == row; };
    auto p = std::find_if(primitives.begin(), primitives.end(), shines);
    if (p == primitives.end()) return nullptr;
    auto number = static_cast<int>(p - primitives.begin());
    return shape_json(scene, flat.geometry.shape_of(number), flat.geometry.index_in_shape(number));
}

json light_json(const Scene& scene, const DeviceScene& flat, const TraceVertex& v) {
    const ShadeNotes& n = v.notes;
    if (!n.pick || !n.light || !n.towards_light) return nullptr;
    auto row = static_cast<std::size_t>(n.pick->row);
    bool delta = n.light->inverse_pdf == 0.f;
    return {{"row", n.pick->row},
            {"kind", emitter_names[static_cast<std::size_t>(flat.lights[row].kind)]},
            {"shape", light_shape(scene, flat, n.pick->row)},
            {"pmf", json_number(n.pick->pmf)},
            {"direction", triple(n.light->wi)},
            {"target", n.light->distant ? json(nullptr) : place(flat.frame, n.light->target)},
            {"pdf", json_number(delta ? 0.f : 1.f / n.light->inverse_pdf)},
            {"radiance_over_pdf", radiance(flat.frame, n.light->weight)},
            {"bsdf", triple(n.towards_light->f)},
            {"bsdf_pdf", json_number(n.towards_light->pdf)},
            {"mis_weight", json_number(n.light_weight.value_or(1.f))},
            {"geometry_share", json_number(n.light_share.value_or(1.f))},
            {"contribution", radiance(flat.frame, v.light)},
            {"shadow_ray", v.shadow_ray},
            {"blocked", v.blocked},
            {"arriving", radiance(flat.frame, v.arriving)}};
}

json scattering_json(const TraceVertex& v) {
    if (!v.notes.scattered) return nullptr;
    const ShadeNotes::Scattered& bsdf = *v.notes.scattered;
    return {{"wi", triple(bsdf.wi)},
            {"pdf", json_number(bsdf.pdf)},
            {"weight", triple(bsdf.weight)},
            {"geometry_share", json_number(v.notes.scattered_share.value_or(1.f))},
            {"eta", json_number(bsdf.eta)}};
}

json roulette_json(const TraceVertex& v) {
    if (!v.notes.roulette) return nullptr;
    const ShadeNotes::Survival& r = *v.notes.roulette;
    return {{"survives", r.alive}, {"throughput_scale", json_number(r.scale)}};
}

json emission_json(const SceneFrame& frame, const TraceVertex& v) {
    if (!v.notes.emission) return nullptr;
    return {{"radiance", radiance(frame, v.notes.emission->radiance)},
            {"mis_weight", json_number(v.notes.emission_weight.value_or(1.f))},
            {"light_pdf", json_number(v.notes.emission->pdf)},
            {"contribution", radiance(frame, v.emission)}};
}

json draws_json(const TraceVertex& v) {
    json draws = json::array();
    for (const ShadeNotes::Draw& draw : v.notes.draws)
        draws.push_back({{"for", draw.decision}, {"numbers", draw.numbers}});
    return draws;
}

void add_surface(const Scene& scene, const DeviceScene& flat, const TraceVertex& v, json& out) {
    const ShadeNotes::Surface& surface = *v.notes.surface;
    out["t"] = json_number(v.t * flat.frame.unit());
    out["shape"] = shape_json(scene, v.shape, v.primitive);
    out["position"] = place(flat.frame, surface.position);
    out["ng"] = triple(surface.ng);
    out["ns"] = triple(surface.ns);
    out["wo"] = triple(v.wo);
    out["material"] = material_json(scene, flat, v.material);
    if (v.material < 0) return;
    out["energy_gain"] = triple(v.notes.energy_gain.value_or(Triple{1, 1, 1}));
    out["next_event"] = light_json(scene, flat, v);
    out["scattering"] = scattering_json(v);
    out["roulette"] = roulette_json(v);
    out["random"] = draws_json(v);
    out["goes_on"] = v.goes_on;
    if (v.goes_on) out["throughput_after"] = triple(v.throughput_after);
}

json vertex_json(const Scene& scene, const DeviceScene& flat, const TraceVertex& v) {
    json out{{"bounce", v.bounce},
             {"origin", place(flat.frame, v.origin)},
             {"direction", triple(v.direction)},
             {"direction_pdf", json_number(v.pdf)},
             {"throughput", triple(v.throughput)},
             {"hit", v.hit},
             {"emission", emission_json(flat.frame, v)},
             {"not_finite", v.not_finite}};
    if (v.hit) add_surface(scene, flat, v, out);
    return out;
}

json left_out_json(const SampleTrace& trace) {
    if (!trace.left_out) return nullptr;
    int bounce = trace.left_out->bounce;
    return {{"stage", trace.left_out->stage()},
            {"fault", trace.left_out->fault_name()},
            {"bounce", bounce < 0 ? json(nullptr) : json(bounce)}};
}

} // namespace

json trace_json(const Scene& scene, const DeviceScene& flat, const SampleTrace& trace) {
    json vertices = json::array();
    for (const TraceVertex& v : trace.vertices)
        vertices.push_back(vertex_json(scene, flat, v));
    return {
        {"scene", scene.file},
        {"pixel", {trace.x, trace.y}},
        {"sample", trace.sample},
        {"seed", scene.sampler.seed},
        {"replicates", scene.sampler.replicates},
        {"sampler", sample_pattern_names[static_cast<std::size_t>(scene.sampler.pattern)]},
        {"on_film", trace.on_film},
        {"vertices", vertices},
        {"radiance", triple(trace.radiance, main_layer_unit(scene.integrator.kind, flat.frame))},
        {"alpha", json_number(trace.alpha)},
        {"weight", json_number(trace.weight)},
        {"left_out", left_out_json(trace)},
        {"first_not_finite_vertex",
         trace.first_not_finite < 0 ? json(nullptr) : json(trace.first_not_finite)}};
}

} // namespace parhelion
