// The list of all numbers that plugins take, each with its domain.
#include "host/scene/mitsuba/number_parameters.h"

#include "host/scene/limits.h"
#include "host/scene/parameter.h"
#include "host/scene/text.h"
#include "kernels/shared/materials.h"

#include <algorithm>
#include <stdexcept>
#include <string>
#include <vector>

namespace parhelion::mitsuba {

namespace {

using enum NumberForm;

/// The least number of single precision with all its digits.
constexpr double least_normal = 1.18e-38;
constexpr Domain share = between(0, 1).zero_below(least_normal);
constexpr Domain count = whole_number(0, largest_int);
/// Single precision ends there.
constexpr Domain radiometric = between(0, 3.4e38);
/// Optics ends at about 10; the squares of more are still far from the end of single precision.
constexpr Domain refractive_index = between(0.01, 100);
/// Those of metals: their formulas know the magnitudes alone.
constexpr Domain complex_index = between(-1e6, 1e6);
/// Less is smooth to single precision: densities of normals are its fourth power. For more, energy
/// compensation is off by more than 0.3 %, of a metal or of glass.
constexpr Domain metal_roughness = between(1e-9, 4).nearest_from(0);
constexpr Domain glass_roughness = between(1e-9, 2).nearest_from(0);
/// Products of three of them are numbers.
constexpr Domain coordinate = between(-1e100, 1e100);
constexpr Domain size = between(1e-100, 1e100);
/// Narrower ones are less than the rounding of a direction, whatever the film.
constexpr Domain field_of_view{
    .lowest = 1e-9, .highest = 180, .below_highest = true, .unit = "degrees"};
/// A narrower one has no more directions in single precision.
constexpr Domain disk_angle = field_of_view;
constexpr Domain half_angle = strictly_between(0, 180).in("degrees");

/// Single precision ends there; the parameter that a texture stands for has a domain of its own.
constexpr Domain texture_value = between(-3.4e38, 3.4e38).zero_below(least_normal);

constexpr Domain wavelength = between(1e-3, 1e9).in("nanometres");

constexpr std::string_view old_files = "files before 2.0";
constexpr std::string_view power = "a power that single precision holds in the scene's unit";
constexpr const char* cameras = "perspective thinlens orthographic";
constexpr const char* perspectives = "perspective thinlens";
constexpr const char* samplers = "independent stratified multijitter orthogonal ldsampler "
                                 "sobol halton hammersley";
constexpr const char* films = "hdrfilm ldrfilm mfilm tiledhdrfilm";

// What numbers a parameter of a material is in files (host/scene/parameter.h).

struct MaterialNumber {
    std::string_view name;
    NumberForm form;
    std::string_view also{};
};
using MaterialNumbers = std::vector<MaterialNumber>;

MaterialNumbers numbers(parameter::Color, std::string_view name) { return {{name, color}}; }
MaterialNumbers numbers(parameter::Number, std::string_view name) { return {{name, real}}; }
MaterialNumbers numbers(parameter::TexturedNumber, std::string_view name) { return {{name, real}}; }
MaterialNumbers numbers(parameter::SpecularIndex, std::string_view name) { return {{name, real}}; }
MaterialNumbers numbers(parameter::Flag, std::string_view) { return {}; }
MaterialNumbers numbers(parameter::Index, std::string_view) {
    return {{"int_ior", real}, {"ext_ior", real}};
}
MaterialNumbers numbers(parameter::SeparateIndex, std::string_view) {
    return {{"int_ior", real, "1.003 times ext_ior or more, or less than it by as much"},
            {"ext_ior", real}};
}
MaterialNumbers numbers(parameter::ComplexIndex, std::string_view) {
    return {{"eta", color}, {"k", color}};
}
MaterialNumbers numbers(parameter::Roughness, std::string_view) {
    return {{"alpha", real}, {"alpha_u", real}, {"alpha_v", real}};
}

MaterialNumbers numbers(parameter::WardRoughness, std::string_view name) {
    return numbers(parameter::Roughness{}, name);
}
MaterialNumbers numbers(parameter::EvenRoughness, std::string_view) { return {{"alpha", real}}; }

/// Kinds that have the same number share a row.
void add(std::vector<NumberParameter>& rows, std::string_view plugin, const MaterialNumber& number,
         const Domain& domain) {
    for (NumberParameter& row : rows)
        if (row.name == number.name && row.form == number.form && row.also == number.also &&
            row.domain == domain) {
            row.plugins += " " + std::string(plugin);
            return;
        }
    rows.push_back({"bsdf", std::string(plugin), number.name, number.form, domain, number.also});
}

/// Of all materials, from their lists.
std::vector<NumberParameter> material_parameters() {
    std::vector<NumberParameter> rows;
#define ADD_NUMBERS(Kind, name, missing, domain, ...)                                              \
    for (const MaterialNumber& number : numbers(parameter::Kind{}, #name))                         \
        add(rows, plugin, number, Domain(domain));
#define ADD_MATERIAL(name, ...)                                                                    \
    {                                                                                              \
        [[maybe_unused]] constexpr std::string_view plugin = #name;                                \
        PARAMETERS_##name(ADD_NUMBERS)                                                             \
    }
    MATERIALS(ADD_MATERIAL)
    return rows;
}

const NumberParameter other_parameters[] = {
    {"bsdf", "conductor roughconductor", "ext_eta", real, refractive_index,
     "1 where eta or k is a texture"},
    {"bsdf", "mask", "opacity", color, share},
    {"bsdf", "blendbsdf", "weight", color, share},
    {"bsdf", "polarizer circular retarder", "transmittance", color, share, "a grey"},
    {"bsdf", "polarizer circular retarder", "theta", color, any_number().in("degrees")},
    {"bsdf", "retarder", "delta", real, any_number().in("degrees")},
    {"bsdf", "bumpmap", "scale", real, between(-1e20, 1e20)},
    {"bsdf", "principled", "specular", real, share, "not with eta"},
    {"bsdf", "principled principledthin", "diffuse_reflectance_sampling_rate", real, radiometric},
    {"bsdf", "principled", "main_specular_sampling_rate", real, radiometric},
    {"bsdf", "principled", "clearcoat_sampling_rate", real, radiometric},
    {"bsdf", "principledthin", "specular_reflectance_sampling_rate", real, radiometric},
    {"bsdf", "principledthin", "specular_transmittance_sampling_rate", real, radiometric},
    {"bsdf", "principledthin", "diffuse_transmittance_sampling_rate", real, radiometric},

    {"emitter", "area constant", "radiance", color, radiometric, power},
    {"emitter", "point spot", "intensity", color, radiometric, power},
    {"emitter", "spot", "texture", color, radiometric, power},
    {"emitter", "directional projector", "irradiance", color, radiometric, power},
    {"emitter", "projector", "scale", real, radiometric, power},
    {"emitter", "projector", "fov", real, field_of_view},
    {"emitter", "projector", "focal_length", text, between(1e-6, 1e12).in("millimetres")},
    {"emitter", "envmap", "scale", real, radiometric, "and what its image becomes by it"},
    {"emitter", "sunsky sun sky", "turbidity", real, between(1, 10)},
    {"emitter", "sunsky sky", "albedo", color, share},
    {"emitter", "sunsky", "sun_scale", real, radiometric, power},
    {"emitter", "sunsky", "sky_scale", real, radiometric, power},
    {"emitter", "sunsky sun sky", "scale", real, radiometric, old_files},
    {"emitter", "sunsky", "sun_aperture", real, disk_angle},
    {"emitter", "sunsky sun", "sun_radius_scale", real, between(0, 300), old_files},
    {"emitter", "sunsky sun sky", "stretch", real, between(1, 2), "1; files before 2.0"},
    {"emitter", "sunsky sun sky", "resolution", whole, whole_number(1, largest_int), old_files},
    {"emitter", "sunsky sun sky", "sun_direction", vector, coordinate,
     "not all 0, and not with a time or place"},
    {"emitter", "sunsky sun sky", "latitude", real, between(-90, 90).in("degrees")},
    {"emitter", "sunsky sun sky", "longitude", real, between(-360, 360).in("degrees")},
    {"emitter", "sunsky sun sky", "timezone", real, between(-24, 24).in("hours")},
    {"emitter", "sunsky sun sky", "year", whole, whole_number(-4000, 10000)},
    {"emitter", "sunsky sun sky", "month", whole, whole_number(1, 12)},
    {"emitter", "sunsky sun sky", "day", whole, whole_number(1, 31)},
    {"emitter", "sunsky sun sky", "hour", real, between(-1e6, 1e6)},
    {"emitter", "sunsky sun sky", "minute", real, between(-1e6, 1e6)},
    {"emitter", "sunsky sun sky", "second", real, between(-1e6, 1e6)},
    {"emitter", "point", "position", vector, coordinate},
    {"emitter", "directional", "direction", vector, coordinate, "not all 0"},
    {"emitter", "spot", "cutoff_angle", real, half_angle},
    {"emitter", "spot", "beam_width", real, between(0, 180).in("degrees"), "up to cutoff_angle"},
    {"emitter", "point spot directional constant envmap projector sunsky sun sky area",
     "sampling_weight", real, greater_than(0)},

    {"texture", "checkerboard", "color0", color, texture_value, "what its parameter takes"},
    {"texture", "checkerboard", "color1", color, texture_value, "what its parameter takes"},
    {"texture", "mesh_attribute", "scale", real, texture_value, "what its parameter takes"},
    {"texture", "rawconstant", "value", vector, texture_value, "what its parameter takes"},

    {"shape", "sphere cylinder", "radius", real, size},
    {"shape", "cylinder", "p0", vector, coordinate, "not p1"},
    {"shape", "cylinder", "p1", vector, coordinate, "not p0"},
    {"shape", "sphere", "center", vector, coordinate},
    {"shape", "serialized", "shape_index", whole, count},
    {"shape", "obj ply serialized rectangle cube sphere disk cylinder",
     "silhouette_sampling_weight", real, any_number()},

    {"sensor", perspectives, "fov", real, field_of_view},
    {"sensor", perspectives, "focal_length", text, between(1e-6, 1e12).in("millimetres")},
    {"sensor", cameras, "near_clip", real, size, "less than far_clip"},
    {"sensor", cameras, "far_clip", real, size, "greater than near_clip"},
    {"sensor", cameras, "focus_distance", real, between(0, 1e100), "thinlens: 1e-20 or greater"},
    {"sensor", cameras, "shutter_open", real, any_number(), "not more than shutter_close"},
    {"sensor", cameras, "shutter_close", real, any_number(), "not less than shutter_open"},
    {"sensor", "perspective", "principal_point_offset_x", real, between(-1000, 1000)},
    {"sensor", "perspective", "principal_point_offset_y", real, between(-1000, 1000)},
    {"sensor", "thinlens", "aperture_radius", real, between(0, 1e20)},

    {"film", films, "width", whole, film_side_domain, "width times height: up to 2^28"},
    {"film", films, "height", whole, film_side_domain, "width times height: up to 2^28"},
    {"film", films, "crop_offset_x", whole, crop_offset_domain, "inside the film"},
    {"film", films, "crop_offset_y", whole, crop_offset_domain, "inside the film"},
    {"film", films, "crop_width", whole, film_side_domain, "inside the film"},
    {"film", films, "crop_height", whole, film_side_domain, "inside the film"},
    {"film", "ldrfilm", "gamma", real, any_number()},
    {"film", "ldrfilm", "exposure", real, any_number()},
    {"film", "ldrfilm", "key", real, any_number()},
    {"film", "ldrfilm", "burn", real, any_number()},
    {"film", "mfilm", "digits", whole, count},

    {"rfilter", "tent", "radius", real, between(1e-6, 16).in("pixels")},
    {"rfilter", "gaussian", "stddev", real, between(1e-6, 4).in("pixels")},
    {"rfilter", "mitchell", "B", real, between(-1, 2)},
    {"rfilter", "mitchell", "C", real, between(-1, 2)},
    {"rfilter", "lanczos", "lobes", whole, whole_number(1, 16)},

    {"sampler", samplers, "sample_count", whole, samples_per_pixel_domain},
    {"sampler", samplers, "seed", whole, seed_domain},
    {"sampler", samplers, "dimension", whole, count},
    {"sampler", "sobol halton hammersley", "scramble", whole, whole_number(-1, largest_int)},
    {"sampler", "orthogonal", "strength", whole, whole_number(0, 64)},

    {"integrator", "path", "max_depth", whole, max_depth_domain},
    {"integrator", "path", "rr_depth", whole, rr_depth_domain},
    {"integrator", "direct", "shading_samples", whole, whole_number(1, largest_int)},
    {"integrator", "direct", "emitter_samples", whole, count, "not 0 with bsdf_samples"},
    {"integrator", "direct", "bsdf_samples", whole, count, "not 0 with emitter_samples"},
    {"integrator", "path direct depth aov moment", "block_size", whole, count},
    {"integrator", "path direct depth aov moment", "samples_per_pass", whole,
     whole_number(0, std::numeric_limits<std::uint32_t>::max())},
    {"integrator", "path direct depth aov moment", "timeout", real,
     Domain{.highest = 0.0}.in("seconds"), "pictures do not depend on the time they take"},

    {"spectrum", "d65", "scale", real, radiometric, power},
    {"spectrum", "d65 srgb", "color", color, radiometric, power},
    {"spectrum", "uniform", "value", real, radiometric, power},
    {"spectrum", "blackbody", "temperature", real, between(1, 1e9).in("kelvins")},
    {"spectrum", "value filename", "wavelength", step, wavelength, "increasing"},

    {"transform", "translate", "x, y, z", step, coordinate},
    {"transform", "scale", "x, y, z", step, coordinate, "shapes: none 0"},
    {"transform", "rotate", "x, y, z", step, coordinate, "not all 0"},
    {"transform", "rotate", "angle", step, any_number().in("degrees")},
    {"transform", "matrix", "value", step, coordinate, "last row 0 0 0 1, to rounding"},
    {"transform", "lookat", "origin, target, up", step, coordinate,
     "origin and target differ, up is not along them"},
};

bool has_plugin(const NumberParameter& parameter, std::string_view plugin) {
    const std::vector<std::string_view> names = split(parameter.plugins, " ");
    return std::find(names.begin(), names.end(), plugin) != names.end();
}

} // namespace

std::span<const NumberParameter> number_parameters() {
    static const std::vector<NumberParameter> parameters = [] {
        std::vector<NumberParameter> all = material_parameters();
        all.insert(all.end(), std::begin(other_parameters), std::end(other_parameters));
        return all;
    }();
    return parameters;
}

const NumberParameter& number_parameter(std::string_view tag, std::string_view plugin,
                                        std::string_view name) {
    for (const NumberParameter& parameter : number_parameters())
        if (parameter.tag == tag && parameter.name == name && has_plugin(parameter, plugin))
            return parameter;
    throw std::logic_error(std::string(tag) + " " + std::string(plugin) + " has a number " +
                           std::string(name) + " that is not in the list");
}

const Domain& step_domain(std::string_view element, std::string_view attribute) {
    return number_parameter("transform", element, attribute).domain;
}

} // namespace parhelion::mitsuba
