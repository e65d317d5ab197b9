// A material as the device reads it, from the lists of parameters.
#include "host/flatten/material_records.h"

#include "host/flatten/gauss_legendre.h"
#include "host/shared_maths.h"

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

void set_roughness(MaterialRecord& m, const parameter::Roughness::Value& r) {
    m.distribution = r.distribution == MicrofacetDistribution::beckmann ? 1 : 0;
    m.alpha_u = static_cast<float>(or_one(r.alpha_u));
    m.alpha_v = static_cast<float>(or_one(r.alpha_v));
}

void set_roughness(MaterialRecord& m, const parameter::EvenRoughness::Value& r) {
    set_roughness(m, parameter::Roughness::Value{r.distribution, r.alpha, r.alpha});
}

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
void texture_roughness(Rows& t, const parameter::Roughness::Value& r, const TextureRow& row) {
    t.alpha_u = row(r.alpha_u.texture);
    t.alpha_v = row(r.alpha_v.texture);
}
void texture_roughness(const Rows&, const parameter::EvenRoughness::Value&, const TextureRow&) {}
void texture_interface(const Rows&, double, const TextureRow&) {}
void texture_alpha_u(const Rows&, double, const TextureRow&) {}
void texture_nothing(const Rows&, bool, const TextureRow&) {}

#define TEXTURE_PARAMETER(Kind, name, missing, domain, stored) texture_##stored(t, b.name, row);
#define TEXTURES_OF_BSDF(name, Name, ...)                                                          \
    void set_textures([[maybe_unused]] Rows& t, [[maybe_unused]] const Name##Bsdf& b,              \
                      [[maybe_unused]] const TextureRow& row) {                                    \
        PARAMETERS_##name(TEXTURE_PARAMETER)                                                       \
    }
MATERIALS(TEXTURES_OF_BSDF)

#define SET_PARAMETER(Kind, name, missing, domain, stored) set_##stored(m, b.name);
#define PACK_BSDF(name, Name, ...)                                                                 \
    void set_parameters([[maybe_unused]] MaterialRecord& m,                                        \
                        [[maybe_unused]] const Name##Bsdf& b) {                                    \
        PARAMETERS_##name(SET_PARAMETER)                                                           \
    }
MATERIALS(PACK_BSDF)

} // namespace

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

} // namespace parhelion
