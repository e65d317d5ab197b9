// The integrator plugins.
#include "host/scene/mitsuba/leniency.h"
#include "host/scene/mitsuba/plugin_table.h"
#include "host/scene/mitsuba/plugins.h"
#include "host/scene/mitsuba/properties.h"

#include <fmt/format.h>

namespace parhelion::mitsuba {

namespace {

struct IntegratorInput {
    Properties& p;
    const Document& document;
    Notes& notes;
};

/// What every sampling integrator of Mitsuba has.
void read_common(Properties& p, Integrator& integrator) {
    integrator.hide_emitters = p.boolean("hide_emitters", false);
    for (const char* const name : {"block_size", "samples_per_pass"})
        if (p.has(name)) {
            p.integer(name, 0);
            p.note(name, in_quotes(name) + " does not change the picture and is not used");
        }
    p.number("timeout", -1.0);
}

Integrator read_path(const IntegratorInput& in) {
    Integrator integrator;
    integrator.kind = IntegratorKind::path;
    integrator.max_depth = static_cast<int>(in.p.integer("max_depth", -1));
    integrator.rr_depth = static_cast<int>(in.p.integer("rr_depth", 5));
    read_common(in.p, integrator);
    return integrator;
}

Integrator read_direct(const IntegratorInput& in) {
    Properties& p = in.p;
    Integrator integrator;
    integrator.kind = IntegratorKind::direct;
    integrator.max_depth = 2;
    if (p.has("shading_samples") && (p.has("emitter_samples") || p.has("bsdf_samples")))
        p.refuse_value("shading_samples",
                       "given together with \"emitter_samples\" or \"bsdf_samples\"",
                       "one or the other");
    const std::int64_t both = p.integer("shading_samples", 1);
    const std::int64_t emitter = p.integer("emitter_samples", both);
    const std::int64_t bsdf = p.integer("bsdf_samples", both);
    if (emitter + bsdf == 0)
        p.refuse_value("bsdf_samples", "0 like \"emitter_samples\"", "one of them above 0");
    integrator.emitter_samples = emitter > 0;
    integrator.bsdf_samples = bsdf > 0;
    if (emitter > 1 || bsdf > 1)
        p.note("", "each camera sample takes one emitter and one bsdf sample; more of them would "
                   "only change the noise (raise sample_count instead)");
    read_common(p, integrator);
    return integrator;
}

Integrator read_depth(const IntegratorInput& in) {
    Integrator integrator;
    integrator.kind = IntegratorKind::depth;
    read_common(in.p, integrator);
    return integrator;
}

Integrator read_normals(const IntegratorInput&) {
    Integrator integrator;
    integrator.kind = IntegratorKind::normals;
    return integrator;
}

/// The integrator inside a wrapper, which may be missing when `kind_without` is given.
Integrator read_nested(const IntegratorInput& in, std::optional<IntegratorKind> kind_without) {
    const std::vector<const Child*> nested = in.p.children("integrator");
    if (nested.size() > 1 || (nested.empty() && !kind_without))
        refuse(in.p.location(), fmt::format("{} holds {} integrators (accepted: {})", in.p.title(),
                                            nested.size(), kind_without ? "0 or 1" : "1"));
    Integrator integrator;
    read_common(in.p, integrator);
    if (!nested.empty()) return read_integrator(in.document, in.p.target(*nested[0]), in.notes);
    integrator.kind = *kind_without;
    return integrator;
}

/// "name:kind, name:kind, ..."
std::vector<AovRequest> parse_aovs(Properties& p) {
    const std::string text = p.required_text("aovs");
    std::vector<AovRequest> result;
    for (const std::string_view item : split(text, ", \t\r\n")) {
        const std::size_t colon = item.find(':');
        if (colon == 0 || colon == item.npos || colon + 1 == item.size() ||
            item.find(':', colon + 1) != item.npos)
            p.refuse_value("aovs", in_quotes(item), "name:kind, separated by commas");
        AovRequest request{std::string(item.substr(0, colon)), std::string(item.substr(colon + 1)),
                           p.location_of("aovs")};
        for (const AovRequest& other : result)
            if (other.name == request.name)
                p.refuse_value("aovs", "using the name " + in_quotes(request.name) + " twice",
                               "different names");
        result.push_back(std::move(request));
    }
    return result;
}

Integrator read_aov(const IntegratorInput& in) {
    Integrator integrator = read_nested(in, IntegratorKind::aov);
    std::vector<AovRequest> aovs = parse_aovs(in.p);
    if (integrator.kind == IntegratorKind::aov && aovs.empty())
        in.p.refuse_value("aovs", "empty", "name:kind, separated by commas");
    integrator.aovs.insert(integrator.aovs.end(), aovs.begin(), aovs.end());
    return integrator;
}

Integrator read_moment(const IntegratorInput& in) {
    Integrator integrator = read_nested(in, std::nullopt);
    integrator.second_moment = true;
    return integrator;
}

using IntegratorReader = Integrator (*)(const IntegratorInput&);

#define PLUGIN(name) {#name, read_##name},
constexpr PluginTable<IntegratorReader, 6> integrator_plugins = {
    {INTEGRATORS(PLUGIN){"moment", read_moment}}};

/// Of another program's, where the caller brings an integrator: what `path` has too.
Integrator read_foreign(const Document& document, const Object& object, Notes& notes) {
    Object path{"integrator", "path", object.id, object.location, {}, {}};
    std::string left_out;
    for (const Parameter& parameter : object.parameters)
        if (parameter.name == "max_depth" || parameter.name == "rr_depth" ||
            parameter.name == "hide_emitters")
            path.parameters.push_back(parameter);
        else
            left_out += (left_out.empty() ? "; left out: " : ", ") + parameter.spelling;
    notes.push_back(fmt::format("{}: integrator plugin {} is not known, --integrator takes its "
                                "place{}",
                                object.location.to_string(), in_quotes(object.plugin), left_out));
    Properties p(document, path, notes);
    Integrator integrator = read_path({p, document, notes});
    p.finish();
    return integrator;
}

} // namespace

Integrator read_integrator(const Document& document, const Object& object, Notes& notes) {
    if (document.own_integrator && !has_plugin(integrator_plugins, object.plugin))
        return read_foreign(document, object, notes);
    const auto kin = kin_outside(integrator_plugins, document, object, notes);
    const Object& known = kin ? *kin : object;
    Properties p(document, known, notes);
    const IntegratorReader read = find_plugin(integrator_plugins, known);
    const Integrator integrator = read({p, document, notes});
    p.finish();
    return integrator;
}

} // namespace parhelion::mitsuba
