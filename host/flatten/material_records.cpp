// A material as the device reads it; one function a kind.
#include "host/flatten/material_records.h"

#include "host/flatten/gauss_legendre.h"
#include "host/shared_maths.h"

namespace parhelion {
namespace {

MaterialRecord record(MaterialKind kind) {
    MaterialRecord m{};
    m.kind = kind;
    m.alpha_u = m.alpha_v = 1.0f;
    return m;
}

void set_reflectance(MaterialRecord& m, const Rgb& c) {
    m.r = static_cast<float>(c.r), m.g = static_cast<float>(c.g), m.b = static_cast<float>(c.b);
}

void set_transmittance(MaterialRecord& m, const Rgb& c) {
    m.tr = static_cast<float>(c.r), m.tg = static_cast<float>(c.g), m.tb = static_cast<float>(c.b);
}

void set_conductor(MaterialRecord& m, const Rgb& eta, const Rgb& k) {
    m.er = static_cast<float>(eta.r), m.eg = static_cast<float>(eta.g),
    m.eb = static_cast<float>(eta.b);
    m.kr = static_cast<float>(k.r), m.kg = static_cast<float>(k.g), m.kb = static_cast<float>(k.b);
}

/// Fresnel reflectance of light from everywhere, weighted by the cosine.
double average_reflectance(double eta, double k) {
    static const GaussLegendre<32> rule;
    return rule.integrate([&](double c) { return 2.0 * c * f64::fresnel_conductor(c, eta, k); });
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

void set_roughness(MaterialRecord& m, MicrofacetDistribution distribution, double alpha_u,
                   double alpha_v) {
    m.distribution = distribution == MicrofacetDistribution::beckmann ? 1 : 0;
    m.alpha_u = static_cast<float>(alpha_u);
    m.alpha_v = static_cast<float>(alpha_v);
}

MaterialRecord pack(const DiffuseBsdf& b) {
    MaterialRecord m = record(material_diffuse);
    set_reflectance(m, b.reflectance);
    return m;
}

MaterialRecord pack(const ConductorBsdf& b) {
    MaterialRecord m = record(material_conductor);
    set_reflectance(m, b.specular_reflectance);
    set_conductor(m, b.eta, b.k);
    return m;
}

template<class Dielectric>
MaterialRecord pack_dielectric(MaterialKind kind, const Dielectric& b) {
    MaterialRecord m = record(kind);
    set_reflectance(m, b.specular_reflectance);
    set_transmittance(m, b.specular_transmittance);
    set_interface(m, b.eta);
    return m;
}

MaterialRecord pack(const DielectricBsdf& b) { return pack_dielectric(material_dielectric, b); }
MaterialRecord pack(const ThinDielectricBsdf& b) {
    return pack_dielectric(material_thindielectric, b);
}

MaterialRecord pack(const RoughConductorBsdf& b) {
    MaterialRecord m = record(material_roughconductor);
    set_reflectance(m, b.specular_reflectance);
    set_conductor(m, b.eta, b.k);
    Rgb average(average_reflectance(b.eta.r, b.k.r), average_reflectance(b.eta.g, b.k.g),
                average_reflectance(b.eta.b, b.k.b));
    set_transmittance(m, b.specular_reflectance * average);
    set_roughness(m, b.distribution, b.alpha_u, b.alpha_v);
    return m;
}

MaterialRecord pack(const RoughDielectricBsdf& b) {
    MaterialRecord m = pack_dielectric(material_roughdielectric, b);
    set_roughness(m, b.distribution, b.alpha_u, b.alpha_v);
    return m;
}

MaterialRecord pack(const NullBsdf&) {
    MaterialRecord m = record(material_null);
    set_reflectance(m, Rgb(1.0));
    return m;
}

} // namespace

MaterialRecord material_record(const Bsdf& bsdf) {
    return std::visit([](const auto& b) { return pack(b); }, bsdf);
}

} // namespace parhelion
