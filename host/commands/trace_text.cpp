// The trace of a sample for people.
#include "host/commands/trace_report.h"

#include "host/safe_text.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace parhelion {
namespace {

using nlohmann::json;

/// A number (of single precision: nine digits say which), or the name of what is none.
std::string plain(const json& v) {
    return v.is_string() ? v.get<std::string>() : fmt::format("{:.9g}", v.get<double>());
}
std::string triple(const json& v) {
    return fmt::format("({}, {}, {})", plain(v[0]), plain(v[1]), plain(v[2]));
}

std::string named(const json& thing, const char* kind) {
    std::string id = as_one_line(thing["id"].get<std::string>());
    return fmt::format("{}{} ({})", thing["index"].get<int>(), id.empty() ? "" : " '" + id + "'",
                       thing[kind].get<std::string>());
}

std::string line(const char* label, const std::string& text) {
    return fmt::format("  {:<12} {}\n", label, text);
}

std::string emission_text(const json& e) {
    return line("emission", fmt::format("{} of weight {}, adds {}", triple(e["radiance"]),
                                        plain(e["mis_weight"]), triple(e["contribution"])));
}

std::string fate(const json& e) {
    if (!e["shadow_ray"].get<bool>()) return "no light arrives";
    return e["blocked"].get<bool>() ? "blocked" : "arrives";
}

/// Said where shading that keeps to the geometry takes something away.
std::string share_text(const json& v) {
    const json& share = v["geometry_share"];
    return share == 1.f ? "" : fmt::format(", of which the geometry lets {} count", plain(share));
}

std::string next_event_text(const json& e) {
    std::string light = fmt::format("{} {}", e["kind"].get<std::string>(), e["row"].get<int>());
    if (!e["shape"].is_null()) light += " of shape " + named(e["shape"], "plugin");
    return line("light", fmt::format("{}, picked with {}, towards {} with density {}", light,
                                     plain(e["pmf"]), triple(e["direction"]), plain(e["pdf"]))) +
           line("", fmt::format("bsdf {} of density {}, weight {}{}, brings {}: {}",
                                triple(e["bsdf"]), plain(e["bsdf_pdf"]), plain(e["mis_weight"]),
                                share_text(e), triple(e["contribution"]), fate(e)));
}

std::string scattering_text(const json& s) {
    return line("scattering",
                fmt::format("local wi {} with density {}, weight {}{}, eta {}", triple(s["wi"]),
                            plain(s["pdf"]), triple(s["weight"]), share_text(s), plain(s["eta"])));
}

std::string roulette_text(const json& r) {
    return line("roulette", r["survives"].get<bool>()
                                ? "survives, throughput times " + plain(r["throughput_scale"])
                                : "ends the path");
}

std::string random_text(const json& draws) {
    std::string text;
    for (const json& draw : draws)
        text += fmt::format("{}{}", text.empty() ? "" : ", ", draw["for"].get<std::string>());
    return line("random", text);
}

std::string material_text(const json& material) {
    return line("material", material.is_null() ? "none: absorbs" : named(material, "kind"));
}

std::string surface_text(const json& v) {
    std::string text =
        line("shape", fmt::format("{}, primitive {}, at t = {}", named(v["shape"], "plugin"),
                                  v["shape"]["primitive"].get<int>(), plain(v["t"]))) +
        line("position", triple(v["position"])) +
        line("ng, ns", fmt::format("{}, {}", triple(v["ng"]), triple(v["ns"]))) +
        line("local wo", triple(v["wo"])) + material_text(v["material"]);
    if (v["material"].is_null()) return text;
    if (v["energy_gain"] != json{1.f, 1.f, 1.f})
        text += line("energy", "throughput times " + triple(v["energy_gain"]) +
                                   " for what is scattered more than once");
    if (!v["next_event"].is_null()) text += next_event_text(v["next_event"]);
    if (!v["scattering"].is_null()) text += scattering_text(v["scattering"]);
    if (!v["roulette"].is_null()) text += roulette_text(v["roulette"]);
    if (!v["random"].empty()) text += random_text(v["random"]);
    if (v["goes_on"].get<bool>())
        text += line("throughput", "becomes " + triple(v["throughput_after"]));
    return text;
}

std::string not_finite_text(const json& names, bool first) {
    std::string text;
    for (const json& name : names)
        text += (text.empty() ? "" : ", ") + name.get<std::string>();
    return line("NOT FINITE", text + (first ? "; here for the first time" : ""));
}

std::string vertex_text(const json& v, const json& first_not_finite) {
    std::string text = fmt::format("vertex {}: {}\n", v["bounce"].get<int>(),
                                   v["hit"].get<bool>() ? "hit" : "miss") +
                       line("ray", fmt::format("from {} along {}, density {}", triple(v["origin"]),
                                               triple(v["direction"]), plain(v["direction_pdf"]))) +
                       line("throughput", triple(v["throughput"]));
    if (v["hit"].get<bool>()) text += surface_text(v);
    if (!v["emission"].is_null()) text += emission_text(v["emission"]);
    if (!v["not_finite"].empty())
        text += not_finite_text(v["not_finite"], first_not_finite == v["bounce"]);
    return text;
}

std::string left_out_text(const json& fault) {
    if (fault.is_null()) return "";
    const json& bounce = fault["bounce"];
    return fmt::format("left out of the image: not finite in {} ({}{})\n",
                       fault["stage"].get<std::string>(), fault["fault"].get<std::string>(),
                       bounce.is_null() ? "" : fmt::format(", bounce {}", bounce.get<int>()));
}

} // namespace

std::string trace_text(const json& trace) {
    std::string text =
        fmt::format("{}: pixel {},{} sample {}, seed {}, sampler {}\n",
                    as_one_line(trace["scene"].get<std::string>()), trace["pixel"][0].get<int>(),
                    trace["pixel"][1].get<int>(), trace["sample"].get<int>(),
                    trace["seed"].get<unsigned>(), trace["sampler"].get<std::string>());
    if (!trace["on_film"].get<bool>())
        return text +
               "the filter puts this sample beyond the edge of the film: it does not count\n";
    for (const json& v : trace["vertices"])
        text += vertex_text(v, trace["first_not_finite_vertex"]);
    return text +
           fmt::format("sum: r, g, b {}, alpha {}, weight {}\n", triple(trace["radiance"]),
                       plain(trace["alpha"]), plain(trace["weight"])) +
           left_out_text(trace["left_out"]);
}

} // namespace parhelion
