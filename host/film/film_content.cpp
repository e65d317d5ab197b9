// What the sums of a film are of, and what picture is made of them.
#include "host/film/film_content.h"

#include "host/error.h"
#include "host/film/whole_number.h"

#include <nlohmann/json.hpp>

namespace parhelion {
namespace {

nlohmann::json to_json(const glm::dvec3& v) { return {v.x, v.y, v.z}; }
glm::dvec3 vector_of(const nlohmann::json& json) {
    return {json.at(0).get<double>(), json.at(1).get<double>(), json.at(2).get<double>()};
}

template<std::size_t N>
nlohmann::json layers_json(const std::vector<AovLayer>& layers,
                           const std::array<AovKindInfo, N>& kinds) {
    nlohmann::json json = nlohmann::json::array();
    for (const AovLayer& layer : layers)
        json.push_back(
            {{"name", layer.name}, {"kind", kinds[layer.kind].name}, {"channel", layer.channel}});
    return json;
}

template<std::size_t N>
std::vector<AovLayer> layers_of(const nlohmann::json& json,
                                const std::array<AovKindInfo, N>& kinds) {
    std::vector<AovLayer> layers;
    for (const nlohmann::json& of_layer : json) {
        const auto name = of_layer.at("kind").get<std::string>();
        int kind = 0;
        while (kind < static_cast<int>(N) && kinds[kind].name != name)
            kind++;
        if (kind == static_cast<int>(N)) throw InputError("there is no layer of kind " + name);
        layers.push_back({of_layer.at("name"), kind, whole_number(of_layer.at("channel"))});
    }
    return layers;
}

nlohmann::json groups_json(const std::vector<LightGroupLayer>& layers) {
    nlohmann::json json = nlohmann::json::array();
    for (const LightGroupLayer& layer : layers)
        json.push_back({{"name", layer.name}, {"channel", layer.channel}});
    return json;
}

nlohmann::json cryptomatte_json(const Cryptomatte& c) {
    nlohmann::json layers = nlohmann::json::array();
    for (const CryptomatteLayer& layer : c.layers)
        layers.push_back({{"name", layer.name}, {"names", layer.names}});
    return {{"depth", c.depth}, {"layers", layers}};
}

Cryptomatte cryptomatte_from(const nlohmann::json& json) {
    Cryptomatte c;
    c.depth = whole_number(json.at("depth"));
    if (c.depth < 1 || c.depth > most_cryptomatte_depth)
        throw InputError("the depth of its mattes is out of range");
    for (const nlohmann::json& layer : json.at("layers"))
        c.layers.push_back({layer.at("name"), layer.at("names").get<std::vector<std::string>>()});
    for (const CryptomatteLayer& layer : c.layers)
        if (layer.names.size() != c.layers[0].names.size())
            throw InputError("its mattes are not of the same shapes");
    return c;
}

template<class Enum>
Enum number_of(const nlohmann::json& json, const char* name, Enum last) {
    const int value = whole_number(json.at(name));
    if (value < 0 || value > static_cast<int>(last))
        throw InputError(std::string(name) + " is out of range");
    return static_cast<Enum>(value);
}

/// Of layers, with room for more than there are.
constexpr int most_channels = 256;

/// What a film may be made by.
void check(const FilmContent& c) {
    const Film& f = c.film;
    const auto inside = [](int from, int count, int all) {
        return from >= 0 && count > 0 && all > 0 && all <= 65536 && from <= all - count;
    };
    bool good = inside(f.crop_x, f.crop_width, f.width) &&
                inside(f.crop_y, f.crop_height, f.height) && c.aovs.channels >= 0 &&
                c.aovs.channels <= most_channels;
    for (const AovLayer& layer : c.aovs.layers)
        good = good && layer.channel >= 0 &&
               layer.channel <= c.aovs.channels - aov_kinds[layer.kind].channels;
    for (const LightGroupLayer& layer : c.aovs.light_groups)
        good = good && layer.channel >= 0 && layer.channel <= c.aovs.channels - 3;
    if (!good) throw InputError("its picture cannot be");
}

} // namespace

FilmContent film_content(const Scene& scene, const AovPlan& aovs, const SceneFrame& frame) {
    return {scene.film, scene.integrator.kind, scene.integrator.second_moment, aovs,
            frame,      cryptomatte_of(scene)};
}

nlohmann::json to_json(const FilmContent& c) {
    const Film& f = c.film;
    return {{"size", {f.width, f.height}},
            {"crop", {f.crop_x, f.crop_y, f.crop_width, f.crop_height}},
            {"pixel_format", f.pixel_format},
            {"component_format", f.component_format},
            {"integrator", c.kind},
            {"second_moment", c.second_moment},
            {"layers", layers_json(c.aovs.layers, aov_kinds)},
            {"layer_channels", c.aovs.channels},
            {"light_groups", groups_json(c.aovs.light_groups)},
            {"cryptomatte", cryptomatte_json(c.cryptomatte)},
            {"film_layers", layers_json(c.aovs.film_layers, film_aov_kinds)},
            {"frame",
             {{"camera", to_json(c.frame.camera)},
              {"shift", to_json(c.frame.shift)},
              {"scale", c.frame.scale},
              {"start", c.frame.start},
              {"radiance_unit", c.frame.radiance_unit}}}};
}

FilmContent film_content(const nlohmann::json& json) {
    FilmContent c;
    const nlohmann::json &size = json.at("size"), &crop = json.at("crop");
    c.film.width = whole_number(size.at(0)), c.film.height = whole_number(size.at(1));
    c.film.crop_x = whole_number(crop.at(0)), c.film.crop_y = whole_number(crop.at(1));
    c.film.crop_width = whole_number(crop.at(2)), c.film.crop_height = whole_number(crop.at(3));
    c.film.pixel_format = number_of(json, "pixel_format", PixelFormat::xyza);
    c.film.component_format = number_of(json, "component_format", ComponentFormat::uint32);
    c.kind = number_of(json, "integrator", IntegratorKind::aov);
    c.second_moment = json.at("second_moment");
    c.aovs.layers = layers_of(json.at("layers"), aov_kinds);
    for (const nlohmann::json& group : json.at("light_groups"))
        c.aovs.light_groups.push_back({group.at("name"), whole_number(group.at("channel"))});
    c.cryptomatte = cryptomatte_from(json.at("cryptomatte"));
    c.aovs.channels = whole_number(json.at("layer_channels"));
    c.aovs.film_layers = layers_of(json.at("film_layers"), film_aov_kinds);
    const nlohmann::json& frame = json.at("frame");
    c.frame = {vector_of(frame.at("camera")), vector_of(frame.at("shift")), frame.at("scale"),
               frame.at("start"), frame.at("radiance_unit")};
    check(c);
    return c;
}

} // namespace parhelion
