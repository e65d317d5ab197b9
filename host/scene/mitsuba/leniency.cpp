// What --lenient takes in the place of a plugin that is not known.
#include "host/scene/mitsuba/leniency.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>

namespace parhelion::mitsuba {

namespace {

/// The plugin that every unknown one of that kind becomes. Kinds that are not here are left out.
struct Kin {
    std::string_view tag, plugin;
};
constexpr std::array<Kin, 5> kin_of_tags = {{{"integrator", "path"},
                                             {"sensor", "perspective"},
                                             {"film", "hdrfilm"},
                                             {"sampler", "independent"},
                                             {"rfilter", "gaussian"}}};

/// Bsdfs of Mitsuba 0.x, of Mitsuba 3 and of its forks that have a nearer kin than `diffuse`.
constexpr std::array<Kin, 3> kin_of_bsdfs = {{{"disneybsdf", "roughplastic"},
                                              {"disneymetal", "roughconductor"},
                                              {"disneyglass", "roughdielectric"}}};

/// Names of the same thing in other plugins; the first that a plugin has is taken.
struct Synonyms {
    std::string_view plugin, name;
    std::array<std::string_view, 4> found;
};
constexpr std::array<Synonyms, 8> synonyms = {
    {{"roughplastic", "diffuse_reflectance", {"diffuse_reflectance", "base_color", "reflectance"}},
     {"roughplastic", "alpha", {"alpha", "roughness"}},
     {"plastic", "diffuse_reflectance", {"diffuse_reflectance", "base_color", "reflectance"}},
     {"diffuse", "reflectance", {"reflectance", "diffuse_reflectance", "base_color", "albedo"}},
     {"roughconductor", "specular_reflectance", {"specular_reflectance", "base_color"}},
     {"roughconductor", "alpha", {"alpha", "roughness"}},
     {"roughdielectric", "alpha", {"alpha", "roughness"}},
     {"roughdielectric", "int_ior", {"int_ior", "eta"}}}};

/// Parameters that integrators, sensors, films and samplers of other programs have under the same
/// names.
constexpr std::array<std::string_view, 24> common_names = {"max_depth",
                                                           "rr_depth",
                                                           "hide_emitters",
                                                           "to_world",
                                                           "fov",
                                                           "fov_axis",
                                                           "focal_length",
                                                           "near_clip",
                                                           "far_clip",
                                                           "width",
                                                           "height",
                                                           "crop_offset_x",
                                                           "crop_offset_y",
                                                           "crop_width",
                                                           "crop_height",
                                                           "pixel_format",
                                                           "sample_count",
                                                           "component_format",
                                                           "seed",
                                                           "sample_border",
                                                           "principal_point_offset_x",
                                                           "principal_point_offset_y",
                                                           "stddev",
                                                           "file_format"};

std::optional<std::string_view> kin_name(const Object& object) {
    if (object.tag == "bsdf") {
        for (const Kin& kin : kin_of_bsdfs)
            if (kin.tag == object.plugin) return kin.plugin;
        return "diffuse";
    }
    for (const Kin& kin : kin_of_tags)
        if (kin.tag == object.tag) return kin.plugin;
    return std::nullopt;
}

/// Roughness from what other models call so (Burley 2012).
void to_alpha(Parameter& p) {
    double value = 0.0;
    if (const auto* real = std::get_if<double>(&p.value))
        value = *real;
    else if (const auto* whole = std::get_if<std::int64_t>(&p.value))
        value = static_cast<double>(*whole);
    else
        return;
    if (p.name == "roughness") p.value = value * value;
}

/// `all` less those that were taken under a name of the kin.
template<typename Items, typename NameOf>
std::string left_out(const Items& all, const std::vector<std::string>& taken, NameOf name_of) {
    std::string names;
    for (const auto& item : all)
        if (std::find(taken.begin(), taken.end(), item.name) == taken.end())
            names += (names.empty() ? "" : ", ") + std::string(name_of(item));
    return names;
}

/// Gives the kin what means the same to it.
std::vector<std::string> take_parameters(const Object& object, Object& kin) {
    std::vector<std::string> taken;
    const auto take = [&](std::string_view from, std::string_view as) {
        for (const Parameter& p : object.parameters)
            if (p.name == from) {
                kin.parameters.push_back(p);
                if (as == "alpha") to_alpha(kin.parameters.back());
                kin.parameters.back().name = as;
                taken.emplace_back(from);
                return true;
            }
        for (const Child& child : object.children)
            if (child.name == from && !child.name.empty()) {
                kin.children.push_back(child);
                kin.children.back().name = as;
                taken.emplace_back(from);
                return true;
            }
        return false;
    };
    if (object.tag != "bsdf")
        for (const std::string_view name : common_names)
            take(name, name);
    for (const Synonyms& s : synonyms)
        if (s.plugin == kin.plugin)
            std::any_of(s.found.begin(), s.found.end(),
                        [&](std::string_view name) { return !name.empty() && take(name, s.name); });
    return taken;
}

const Child* first_bsdf(const Document& document, const Object& object) {
    for (const Child& child : object.children)
        if (document.objects[child.object].tag == "bsdf") return &child;
    return nullptr;
}

/// What holds one bsdf, and is not known, is that one.
std::optional<Object> held_bsdf(const Document& document, const Object& object) {
    if (object.tag != "bsdf") return std::nullopt;
    const Child* const held = first_bsdf(document, object);
    if (!held) return std::nullopt;
    Object same = document.objects[held->object];
    if (same.id.empty()) same.id = object.id;
    return same;
}

} // namespace

std::optional<Object> nearest_kin(const Document& document, const Object& object,
                                  std::vector<std::string>& notes) {
    const auto say = [&](const std::string& what) {
        notes.push_back(fmt::format("{}: {} plugin {} is not known and {}",
                                    object.location.to_string(), object.tag,
                                    in_quotes(object.plugin), what));
    };
    if (std::optional<Object> held = held_bsdf(document, object)) {
        say(fmt::format("the first bsdf that it holds, {}, takes its place",
                        in_quotes(held->plugin)));
        return held;
    }
    const std::optional<std::string_view> name = kin_name(object);
    if (!name) return std::nullopt;
    Object kin{object.tag, std::string(*name), object.id, object.location, {}, {}};
    const std::vector<std::string> taken = take_parameters(object, kin);
    for (const Child& child : object.children) {
        const std::string& tag = document.objects[child.object].tag;
        if (tag == "film" || tag == "sampler" || tag == "rfilter") kin.children.push_back(child);
    }
    const std::string lost =
        left_out(object.parameters, taken, [](const Parameter& p) { return p.spelling; });
    say(fmt::format("read as {}{}", in_quotes(kin.plugin),
                    lost.empty() ? "" : "; left out: " + lost));
    return kin;
}

} // namespace parhelion::mitsuba
