// The bsdf plugins that are one material: their parameters.
#include "host/scene/mitsuba/bsdfs.h"

#include "host/scene/mitsuba/properties.h"
#include "host/scene/text.h"

#include <fmt/format.h>

#include <glm/common.hpp>

#include <algorithm>
#include <cmath>

namespace parhelion::mitsuba {

namespace {

struct NamedIndex {
    std::string_view name;
    double value;
};

/// Indices of refraction at 589 nm and room temperature (Hecht, Optics; the names are Mitsuba's).
constexpr std::array<NamedIndex, 23> named_indices = {
    {{"vacuum", 1.0},      {"helium", 1.000036},        {"hydrogen", 1.000132},
     {"air", 1.000277},    {"carbon dioxide", 1.00045}, {"water", 1.3330},
     {"acetone", 1.36},    {"ethanol", 1.361},          {"carbon tetrachloride", 1.461},
     {"glycerol", 1.4729}, {"benzene", 1.501},          {"silicone oil", 1.52045},
     {"bromine", 1.661},   {"water ice", 1.31},         {"fused quartz", 1.458},
     {"pyrex", 1.470},     {"acrylic glass", 1.49},     {"polypropylene", 1.49},
     {"bk7", 1.5046},      {"sodium chloride", 1.544},  {"amber", 1.55},
     {"pet", 1.5750},      {"diamond", 2.419}}};

struct ConductorPreset {
    std::string_view name;
    Rgb eta, k;
};

const ConductorPreset conductor_presets[] = {
#include "host/scene/mitsuba/conductor_presets.inl"
};

template<typename Entries>
std::string names_of(const Entries& entries) {
    std::string result;
    for (const auto& entry : entries)
        result += (result.empty() ? "" : ", ") + std::string(entry.name);
    return result;
}

bool is_text(const Properties& p, std::string_view name) {
    for (const Parameter& parameter : p.object().parameters)
        if (parameter.name == name) return std::holds_alternative<std::string>(parameter.value);
    return false;
}

/// A number, or the name of a medium.
double read_index(Properties& p, std::string_view name, double missing) {
    if (!is_text(p, name)) return p.number(name, missing);
    const std::string wanted = lower_case(p.text(name, ""));
    for (const NamedIndex& entry : named_indices)
        if (entry.name == wanted) return entry.value;
    p.refuse_value(name, in_quotes(wanted), "a number, or one of " + names_of(named_indices));
}

// One function a kind of parameter: its value, `missing` where the file has none.

Textured<Rgb> read(parameter::Color, Properties& p, std::string_view name,
                   const Textured<Rgb>& missing) {
    return p.textured_color(name, missing, SpectrumUse::reflectance);
}

double read(parameter::Number, Properties& p, std::string_view name, double missing) {
    return p.number(name, missing);
}

Textured<double> read(parameter::TexturedNumber, Properties& p, std::string_view name,
                      const Textured<double>& missing) {
    return p.textured_number(name, missing);
}

double read(parameter::SpecularIndex, Properties& p, std::string_view name, double missing) {
    if (!p.has("specular")) return p.number(name, missing);
    if (p.has(name)) p.refuse_value("specular", "given together with \"eta\"", "one or the other");
    return 2.0 / (1.0 - std::sqrt(0.08 * p.number("specular", 0.5))) - 1.0;
}

bool read(parameter::Flag, Properties& p, std::string_view name, bool missing) {
    return p.boolean(name, missing);
}

double read(parameter::Index, Properties& p, std::string_view, double missing) {
    constexpr double air = 1.000277;
    const bool given = p.has("int_ior") || p.has("ext_ior");
    const double inside = read_index(p, "int_ior", missing * air);
    const double outside = read_index(p, "ext_ior", air);
    return given ? inside / outside : missing;
}

double read(parameter::SeparateIndex, Properties& p, std::string_view name, double missing) {
    const double eta = read(parameter::Index{}, p, name, missing);
    // The nearer, the narrower the lobe of refraction: the energy table is too coarse for less.
    constexpr double nearest = 1.003;
    if (std::max(eta, 1.0 / eta) < nearest)
        p.refuse_value("int_ior", fmt::format("{} times \"ext_ior\"", eta),
                       fmt::format("two indices, one {} times the other or more", nearest));
    return eta;
}

/// Mitsuba's formulas square them: of measured metals some are a little below zero.
Textured<Rgb> read_magnitudes(Properties& p, std::string_view name, const Textured<Rgb>& missing) {
    const Textured<Rgb> value = p.textured_color(name, missing, SpectrumUse::unbounded);
    if (value.texture) return value;
    const Rgb magnitude = glm::abs(value.constant);
    if (magnitude != value.constant)
        p.note(name, fmt::format("{} is negative; its magnitude is used, as in Mitsuba",
                                 in_quotes(name)));
    return magnitude;
}

parameter::ComplexIndex::Value read_metal(Properties& p, parameter::ComplexIndex::Value index) {
    const bool spectra = p.has("eta") || p.has("k");
    if (!p.has("material")) {
        index.eta = read_magnitudes(p, "eta", index.eta);
        index.k = read_magnitudes(p, "k", index.k);
        return index;
    }
    if (spectra)
        p.refuse_value("material", "given together with \"eta\" or \"k\"", "one or the other");
    const std::string wanted = p.text("material", "none");
    for (const ConductorPreset& preset : conductor_presets)
        if (preset.name == wanted) return {preset.eta, preset.k};
    p.refuse_value("material", in_quotes(wanted), names_of(conductor_presets));
}

parameter::ComplexIndex::Value read(parameter::ComplexIndex, Properties& p, std::string_view,
                                    const parameter::ComplexIndex::Value& missing) {
    const parameter::ComplexIndex::Value metal = read_metal(p, missing);
    const double outside = read_index(p, "ext_eta", 1.0);
    if (outside == 1.0) return metal;
    if (metal.eta.texture || metal.k.texture)
        p.refuse_value("ext_eta", fmt::format("{} beside a texture", outside),
                       "1 where \"eta\" or \"k\" is a texture");
    return {metal.eta.constant / outside, metal.k.constant / outside};
}

MicrofacetDistribution read_distribution(Properties& p) {
    const std::size_t kind = p.choice("distribution", "beckmann", {"beckmann", "ggx"});
    // Sampling all or only the visible normals gives the same picture with other noise.
    if (!p.boolean("sample_visible", true))
        p.note("sample_visible", "\"sample_visible\" is taken as true; only the noise differs");
    return kind == 0 ? MicrofacetDistribution::beckmann : MicrofacetDistribution::ggx;
}

parameter::EvenRoughness::Value read(parameter::EvenRoughness, Properties& p, std::string_view,
                                     const parameter::EvenRoughness::Value& missing) {
    return {read_distribution(p), p.number("alpha", missing.alpha)};
}

parameter::Roughness::Value read(parameter::Roughness, Properties& p, std::string_view,
                                 const parameter::Roughness::Value& missing) {
    const MicrofacetDistribution distribution = read_distribution(p);
    const bool split = p.has("alpha_u") || p.has("alpha_v");
    if (!split) {
        const Textured<double> alpha = p.textured_number("alpha", missing.alpha_u);
        return {distribution, alpha, alpha};
    }
    if (p.has("alpha"))
        p.refuse_value("alpha", "given together with \"alpha_u\" or \"alpha_v\"",
                       "\"alpha\", or both of the others");
    const auto required = [&](const char* name) {
        return p.has(name) ? p.textured_number(name, {}) : p.required_number(name);
    };
    const Textured<double> alpha_u = required("alpha_u");
    return {distribution, alpha_u, required("alpha_v")};
}

/// As in Mitsuba 0.6 `alpha` is what `alpha_u` and `alpha_v` are without a value of their own.
parameter::WardRoughness::Value read(parameter::WardRoughness, Properties& p, std::string_view,
                                     const parameter::WardRoughness::Value& missing) {
    const auto variant = static_cast<WardVariant>(
        p.choice("variant", "balanced", {"balanced", "ward", "ward-duer"}));
    const double alpha = p.number("alpha", missing.alpha_u.constant);
    const Textured<double> alpha_u = p.textured_number("alpha_u", alpha);
    return {variant, alpha_u, p.textured_number("alpha_v", alpha)};
}

/// Measured in white furnaces (docs/accuracy.md): where the energy table is too coarse. `rougher`
/// is what the larger roughness may be.
void note_compensation(Properties& p, const auto& b, double rougher) {
    const parameter::Roughness::Value& r = b.roughness;
    if (!b.energy_compensation) return;
    if (has_textured_lobe(b)) {
        p.note("", "there is no energy compensation where roughness or index are textures");
        return;
    }
    constexpr double ratio = 10.0;
    const auto [low, high] = std::minmax(r.alpha_u.constant, r.alpha_v.constant);
    if (low == high || (high <= ratio * low && high <= rougher)) return;
    p.note("alpha_u", fmt::format("energy compensation is off by more than 0.3 % where "
                                  "\"alpha_u\" and \"alpha_v\" differ more than {} times, or one "
                                  "is above {}",
                                  ratio, rougher));
}

/// What is said of several parameters of a kind together; of most nothing.
void note_together(const Properties&, const auto&) {}

void note_together(Properties& p, const RoughConductorBsdf& b) { note_compensation(p, b, 1.0); }

void note_together(Properties& p, const RoughDielectricBsdf& b) { note_compensation(p, b, 0.3); }

void note_together(Properties& p, const RoughPlasticBsdf& b) {
    if (b.energy_compensation && has_thin_base(b))
        p.note("int_ior", "there is no energy compensation where \"int_ior\" is less than "
                          "\"ext_ior\"");
}

/// Where Mitsuba 0.6 and 3 differ, a number of a texture is that of 3.
void note_luminance(Properties& p, std::string_view name, const Textured<double>& value) {
    if (!value.texture) return;
    const auto* bitmap = std::get_if<BitmapTexture>(&value.texture.texture->kind);
    if (bitmap && bitmap->source.layout.channels > 1)
        p.note(name, "colours count by their luminance; in Mitsuba 0.6 by the mean of their "
                     "channels, which is the same of greys");
}

void note_together(Properties& p, const PhongBsdf& b) { note_luminance(p, "exponent", b.exponent); }

void note_together(Properties& p, const WardBsdf& b) {
    note_luminance(p, "alpha_u", b.roughness.alpha_u);
    note_luminance(p, "alpha_v", b.roughness.alpha_v);
}

/// They weigh what directions are drawn from, which we do by what each sends on.
void read_sampling_rates(Properties& p, std::initializer_list<const char*> names) {
    for (const char* name : names)
        if (p.number(name, 1.0) != 1.0)
            p.note(name,
                   fmt::format("{} changes only the noise, and is not used", in_quotes(name)));
}

/// Facets between equal indices bend nothing: Mitsuba takes others.
void note_together(Properties& p, PrincipledBsdf& b) {
    read_sampling_rates(p, {"diffuse_reflectance_sampling_rate", "main_specular_sampling_rate",
                            "clearcoat_sampling_rate"});
    constexpr double nearest = 1.001;
    if (is_opaque(b) || std::max(b.eta, 1.0 / b.eta) >= nearest) return;
    const bool specular = p.has("specular");
    b.eta = specular && b.eta == 1.0 ? 2.0 / (1.0 - std::sqrt(0.08 * 1e-3)) - 1.0 : nearest;
    p.note(specular ? "specular" : "eta",
           fmt::format("\"spec_trans\" needs two indices: \"eta\" is taken as {}", b.eta));
}

void note_together(Properties& p, PrincipledThinBsdf&) {
    read_sampling_rates(
        p, {"diffuse_reflectance_sampling_rate", "specular_reflectance_sampling_rate",
            "specular_transmittance_sampling_rate", "diffuse_transmittance_sampling_rate"});
}

} // namespace

#define READ_PARAMETER(Kind, name, ...) b.name = read(parameter::Kind{}, p, #name, b.name);
#define BSDF_READER(name, Name, ...)                                                               \
    Bsdf read_##name(Properties& p) {                                                              \
        Name##Bsdf b;                                                                              \
        PARAMETERS_##name(READ_PARAMETER);                                                         \
        note_together(p, b);                                                                       \
        return b;                                                                                  \
    }
MATERIALS(BSDF_READER)

} // namespace parhelion::mitsuba
