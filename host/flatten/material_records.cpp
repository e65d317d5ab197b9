// A material as the device reads it, from the lists of parameters.
#include "host/flatten/material_records.h"

#include "host/flatten/gauss_legendre.h"
#include "host/shared_maths.h"

#include <algorithm>
#include <array>
#include <string_view>

namespace parhelion {
namespace {

// What parameters become, by the last word of their lists in kernels/shared/materials.h.

#define SET_WORD(type, name)                                                                       \
    [[maybe_unused]] void set_##name(MaterialRecord& m, double value) {                            \
        m.name = static_cast<type>(value);                                                         \
    }
MATERIAL_FIELDS(SET_WORD)

/// 1 where a texture tells the value, which the device multiplies by it, or puts in its place.
template<class T>
T or_one(const Textured<T>& value) {
    return value.texture ? T(1.0) : value.constant;
}

void set_reflectance(MaterialRecord& m, const Textured<Rgb>& color) {
    const Rgb c = or_one(color);
    m.r = static_cast<float>(c.r), m.g = static_cast<float>(c.g), m.b = static_cast<float>(c.b);
}

void set_transmittance(MaterialRecord& m, const Textured<Rgb>& color) {
    const Rgb c = or_one(color);
    m.tr = static_cast<float>(c.r), m.tg = static_cast<float>(c.g), m.tb = static_cast<float>(c.b);
}

void set_conductor(MaterialRecord& m, const parameter::ComplexIndex::Value& index) {
    const Rgb eta = or_one(index.eta), k = or_one(index.k);
    m.er = static_cast<float>(eta.r), m.eg = static_cast<float>(eta.g),
    m.eb = static_cast<float>(eta.b);
    m.kr = static_cast<float>(k.r), m.kg = static_cast<float>(k.g), m.kb = static_cast<float>(k.b);
}

/// eta^2 - 1 from both sides in two floats each, so that the device can tell on which side of the
/// critical angle a direction lies.
void set_interface(MaterialRecord& m, double eta) {
    double outside = (eta - 1.0) * (eta + 1.0), inside = -outside / (eta * eta);
    m.er = static_cast<float>(eta);
    m.eg = static_cast<float>(1.0 / eta);
    m.eb = static_cast<float>(outside);
    m.kr = static_cast<float>(outside - m.eb);
    m.kg = static_cast<float>(inside);
    m.kb = static_cast<float>(inside - m.kg);
}

void set_alphas(MaterialRecord& m, const auto& roughness) {
    m.alpha_u = static_cast<float>(or_one(roughness.alpha_u));
    m.alpha_v = static_cast<float>(or_one(roughness.alpha_v));
}

void set_roughness(MaterialRecord& m, const parameter::Roughness::Value& r) {
    m.distribution = r.distribution == MicrofacetDistribution::beckmann ? 1 : 0;
    set_alphas(m, r);
}

void set_roughness(MaterialRecord& m, const parameter::EvenRoughness::Value& r) {
    set_roughness(m, parameter::Roughness::Value{r.distribution, r.alpha, r.alpha});
}

void set_ward(MaterialRecord& m, const parameter::WardRoughness::Value& r) {
    WARD_VARIANT(m) = static_cast<float>(r.variant);
    set_alphas(m, r);
}

#define SET_TEXTURED_WORD(name)                                                                    \
    void set_##name(MaterialRecord& m, const Textured<double>& value) {                            \
        m.name = static_cast<float>(or_one(value));                                                \
    }
SET_TEXTURED_WORD(alpha_u)
SET_TEXTURED_WORD(alpha_v)
NUMBER_WORDS(SET_TEXTURED_WORD)

void set_nothing(const MaterialRecord&, bool) {} // for the host alone

/// Fresnel reflectance of light from everywhere, weighted by the cosine.
double average_reflectance(double eta, double k) {
    static const GaussLegendre<32> rule;
    return rule.integrate([&](double c) { return 2.0 * c * f64::fresnel_conductor(c, eta, k); });
}

/// What follows from several parameters of a kind; of most nothing.
void derive(const MaterialRecord&, const auto&) {}

/// Rough metals keep their average reflectance in place of a transmittance.
void derive(MaterialRecord& m, const RoughConductorBsdf& b) {
    const Rgb eta = or_one(b.index.eta), k = or_one(b.index.k);
    Rgb average(average_reflectance(eta.r, k.r), average_reflectance(eta.g, k.g),
                average_reflectance(eta.b, k.b));
    set_transmittance(m, or_one(b.specular_reflectance) * average);
}

/// What a coat sends back to its base, see types.h.
void derive(MaterialRecord& m, const PlasticBsdf& b) {
    double inside = inner_reflectance(b.eta);
    m.kg = static_cast<float>(b.nonlinear ? -inside : inside);
    m.kb = 0.f;
}

/// A rough one's comes with its table, as does what it lets through; until then it is a smooth
/// one's, and everything.
void derive(MaterialRecord& m, const RoughPlasticBsdf& b) {
    double inside = inner_reflectance(b.eta);
    m.kg = static_cast<float>(b.nonlinear ? -inside : inside);
    m.kb = m.eg = 1.f;
}

/// Opaque ones say so.
void derive(MaterialRecord& m, const PrincipledBsdf& b) { m.distribution = is_opaque(b) ? 1 : 0; }

/// What Mitsuba 0.6 makes of reflectances that are more than 1 together; where a texture tells of
/// one, that is known later.
template<class Kind>
requires requires(const Kind& b) { b.ensure_energy_conservation; }
void derive(MaterialRecord& m, const Kind& b) {
    if (b.diffuse_reflectance.texture || b.specular_reflectance.texture) return;
    scale_reflectances(
        m, kept_share(b, b.diffuse_reflectance.constant, b.specular_reflectance.constant));
}

// Textures of parameters, by the same word.

using Rows = MaterialTexturesRecord;

void texture_reflectance(Rows& t, const Textured<Rgb>& c, const TextureRow& row) {
    t.reflectance = row(c.texture);
}
void texture_transmittance(Rows& t, const Textured<Rgb>& c, const TextureRow& row) {
    t.transmittance = row(c.texture);
}
void texture_conductor(Rows& t, const parameter::ComplexIndex::Value& index,
                       const TextureRow& row) {
    t.eta = row(index.eta.texture);
    t.k = row(index.k.texture);
}
void texture_alphas(Rows& t, const auto& roughness, const TextureRow& row) {
    t.alpha_u = row(roughness.alpha_u.texture);
    t.alpha_v = row(roughness.alpha_v.texture);
}
void texture_roughness(Rows& t, const parameter::Roughness::Value& r, const TextureRow& row) {
    texture_alphas(t, r, row);
}
void texture_ward(Rows& t, const parameter::WardRoughness::Value& r, const TextureRow& row) {
    texture_alphas(t, r, row);
}
void texture_roughness(const Rows&, const parameter::EvenRoughness::Value&, const TextureRow&) {}
void texture_interface(const Rows&, double, const TextureRow&) {}
template<class Number> // of one that cannot be a texture none
void texture_alpha_u(Rows& t, const Number& alpha, const TextureRow& row) {
    if constexpr (requires { alpha.texture; }) t.alpha_u = row(alpha.texture);
}
void texture_alpha_v(Rows& t, const Textured<double>& alpha, const TextureRow& row) {
    t.alpha_v = row(alpha.texture);
}
/// They have rows of their own, below.
#define NO_TEXTURE_OF_WORD(name)                                                                   \
    void texture_##name(const Rows&, const auto&, const TextureRow&) {}
NUMBER_WORDS(NO_TEXTURE_OF_WORD)
void texture_nothing(const Rows&, bool, const TextureRow&) {}

#define TEXTURE_PARAMETER(Kind, name, missing, domain, stored) texture_##stored(t, b.name, row);
#define TEXTURES_OF_BSDF(name, Name, ...)                                                          \
    void set_textures([[maybe_unused]] Rows& t, [[maybe_unused]] const Name##Bsdf& b,              \
                      [[maybe_unused]] const TextureRow& row) {                                    \
        PARAMETERS_##name(TEXTURE_PARAMETER)                                                       \
    }
MATERIALS(TEXTURES_OF_BSDF)

/// Where a word stands among those that a table of rows tells; -1: elsewhere.
#define NUMBER_NAME(name) #name,
constexpr int number_of(std::string_view word) {
    constexpr std::array<std::string_view, NUMBER_ROWS> words{NUMBER_WORDS(NUMBER_NAME)};
    auto found = std::find(words.begin(), words.end(), word);
    return found == words.end() ? -1 : static_cast<int>(found - words.begin());
}

void add_row(std::vector<int>&, std::string_view, const auto&, const TextureRow&) {}
void add_row(std::vector<int>& rows, std::string_view word, const Textured<double>& value,
             const TextureRow& row) {
    const int place = number_of(word);
    if (place < 0 || !value.texture) return;
    if (rows.empty()) rows.assign(NUMBER_ROWS, -1);
    rows[static_cast<std::size_t>(place)] = row(value.texture);
}

#define ADD_NUMBER_ROW(Kind, name, missing, domain, stored) add_row(rows, #stored, b.name, row);
#define NUMBER_ROWS_OF_BSDF(name, Name, ...)                                                       \
    void add_rows([[maybe_unused]] std::vector<int>& rows, [[maybe_unused]] const Name##Bsdf& b,   \
                  [[maybe_unused]] const TextureRow& row) {                                        \
        PARAMETERS_##name(ADD_NUMBER_ROW)                                                          \
    }
MATERIALS(NUMBER_ROWS_OF_BSDF)

#define SET_PARAMETER(Kind, name, missing, domain, stored) set_##stored(m, b.name);
#define PACK_BSDF(name, Name, ...)                                                                 \
    void set_parameters([[maybe_unused]] MaterialRecord& m,                                        \
                        [[maybe_unused]] const Name##Bsdf& b) {                                    \
        PARAMETERS_##name(SET_PARAMETER)                                                           \
    }
MATERIALS(PACK_BSDF)

} // namespace

void scale_reflectances(MaterialRecord& m, double share) {
    for (float* word : {&m.r, &m.g, &m.b, &m.tr, &m.tg, &m.tb})
        *word = static_cast<float>(*word * share);
}

double inner_reflectance(double eta) {
    static const GaussLegendre<32> rule;
    auto average = [](double index) {
        const f64::Interface face{index, 1.0 / index, (index - 1.0) * (index + 1.0), 0.0};
        return rule.integrate(
            [&](double c) { return 2.0 * c * f64::fresnel_dielectric(c, face).reflectance; });
    };
    if (eta < 1.0) return average(1.0 / eta);
    return 1.0 - (1.0 - average(eta)) / (eta * eta);
}

MaterialRecord material_record(const Bsdf& bsdf) {
    MaterialRecord m{};
    m.kind = static_cast<int>(bsdf.index());
    m.alpha_u = m.alpha_v = 1.0f;
    set_reflectance(m, Rgb(1.0));
    std::visit(
        [&](const auto& b) {
            set_parameters(m, b);
            derive(m, b);
        },
        bsdf);
    return m;
}

MaterialTexturesRecord material_textures(const Bsdf& bsdf, const TextureRow& row) {
    MaterialTexturesRecord t = no_textures;
    std::visit([&](const auto& b) { set_textures(t, b, row); }, bsdf);
    return t;
}

std::vector<int> number_rows(const Bsdf& bsdf, const TextureRow& row) {
    std::vector<int> rows;
    std::visit([&](const auto& b) { add_rows(rows, b, row); }, bsdf);
    return rows;
}

} // namespace parhelion
