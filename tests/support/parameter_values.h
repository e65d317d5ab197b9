// Values for every parameter of every material of the list, how files write them, and what a
// material is to the kernels.
#pragma once

#include "host/scene/material.h"
#include "host/shared_maths.h"

#include <fmt/format.h>

#include <cmath>
#include <concepts>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

namespace parhelion::test {

/// visit(kind of parameter, name, value) for each parameter of a material.
#define VISIT_PARAMETER(Kind, name, ...) visit(parameter::Kind{}, #name, b.name);
#define VISIT_PARAMETERS(name, Name, ...)                                                          \
    template<class B, class Visit>                                                                 \
    requires std::same_as<std::remove_const_t<B>, Name##Bsdf> void each_parameter(                 \
        [[maybe_unused]] B& b, [[maybe_unused]] Visit visit) {                                     \
        PARAMETERS_##name(VISIT_PARAMETER)                                                         \
    }
MATERIALS(VISIT_PARAMETERS)
#undef VISIT_PARAMETERS
#undef VISIT_PARAMETER

/// One of every kind, with what it has where a file says nothing.
inline std::vector<Bsdf> every_bsdf() {
#define MISSING_BSDF(name, Name, ...) Name##Bsdf{},
    return {MATERIALS(MISSING_BSDF)};
#undef MISSING_BSDF
}

/// Numbers of which no two are alike.
class Unlike {
public:
    /// In 0.2 to 0.8, as lie in the domain of any parameter.
    double share() { return 0.2 + 0.6 * std::fmod(0.618 * ++given_, 1.0); }
    Rgb color() {
        double r = share(), g = share();
        return {r, g, share()};
    }

private:
    int given_ = 0;
};

inline void set_unlike(parameter::Color, Textured<Rgb>& v, Unlike& u) { v = u.color(); }
inline void set_unlike(parameter::Number, double& v, Unlike& u) { v = u.share(); }
inline void set_unlike(parameter::TexturedNumber, Textured<double>& v, Unlike& u) { v = u.share(); }
inline void set_unlike(parameter::SpecularIndex, double& v, Unlike& u) { v = 1 + u.share(); }
inline void set_unlike(parameter::Flag, bool& v, Unlike&) { v = !v; }
inline void set_unlike(parameter::Index, double& v, Unlike& u) { v = 1 + u.share(); }
inline void set_unlike(parameter::SeparateIndex, double& v, Unlike& u) { v = 1 + u.share(); }
inline void set_unlike(parameter::ComplexIndex, parameter::ComplexIndex::Value& v, Unlike& u) {
    v = {u.color(), Rgb(4.0 * u.color())};
}
inline void set_unlike(parameter::EvenRoughness, parameter::EvenRoughness::Value& v, Unlike& u) {
    v = {MicrofacetDistribution::ggx, u.share()};
}
inline void set_unlike(parameter::Roughness, parameter::Roughness::Value& v, Unlike& u) {
    v = {MicrofacetDistribution::ggx, u.share(), u.share()};
}
inline void set_unlike(parameter::WardRoughness, parameter::WardRoughness::Value& v, Unlike& u) {
    v = {WardVariant::ward, u.share(), u.share()};
}

/// Every kind, each of its numbers unlike what is there where a file says nothing.
inline std::vector<Bsdf> every_unlike_bsdf() {
    std::vector<Bsdf> bsdfs = every_bsdf();
    Unlike unlike;
    for (Bsdf& bsdf : bsdfs)
        std::visit(
            [&](auto& b) {
                each_parameter(b, [&](auto kind, const char*, auto& value) {
                    set_unlike(kind, value, unlike);
                });
            },
            bsdf);
    return bsdfs;
}

// The same value in a file.

inline std::string in_file(parameter::Color, std::string_view name, const Textured<Rgb>& color) {
    const Rgb& c = color.constant;
    return fmt::format("<rgb name='{}' value='{} {} {}'/>", name, c.r, c.g, c.b);
}
inline std::string in_file(parameter::Number, std::string_view name, double v) {
    return fmt::format("<float name='{}' value='{}'/>", name, v);
}
inline std::string in_file(parameter::TexturedNumber, std::string_view name,
                           const Textured<double>& v) {
    return in_file(parameter::Number{}, name, v.constant);
}
inline std::string in_file(parameter::SpecularIndex, std::string_view name, double eta) {
    return in_file(parameter::Number{}, name, eta);
}
inline std::string in_file(parameter::Flag, std::string_view name, bool v) {
    return fmt::format("<boolean name='{}' value='{}'/>", name, v);
}
inline std::string in_file(parameter::Index, std::string_view, double eta) {
    return in_file(parameter::Number{}, "int_ior", eta * 1.25) +
           in_file(parameter::Number{}, "ext_ior", 1.25);
}
inline std::string in_file(parameter::SeparateIndex, std::string_view name, double eta) {
    return in_file(parameter::Index{}, name, eta);
}
inline std::string in_file(parameter::ComplexIndex, std::string_view,
                           const parameter::ComplexIndex::Value& v) {
    return in_file(parameter::Color{}, "eta", v.eta) + in_file(parameter::Color{}, "k", v.k);
}
inline std::string in_file(MicrofacetDistribution d) {
    bool ggx = d == MicrofacetDistribution::ggx;
    return fmt::format("<string name='distribution' value='{}'/>", ggx ? "ggx" : "beckmann");
}
inline std::string in_file(parameter::EvenRoughness, std::string_view,
                           const parameter::EvenRoughness::Value& v) {
    return in_file(v.distribution) + in_file(parameter::Number{}, "alpha", v.alpha);
}
inline std::string in_file(parameter::Roughness, std::string_view,
                           const parameter::Roughness::Value& v) {
    return in_file(v.distribution) + in_file(parameter::Number{}, "alpha_u", v.alpha_u.constant) +
           in_file(parameter::Number{}, "alpha_v", v.alpha_v.constant);
}
inline std::string in_file(parameter::WardRoughness, std::string_view,
                           const parameter::WardRoughness::Value& v) {
    constexpr std::string_view names[] = {"balanced", "ward", "ward-duer"};
    return fmt::format("<string name='variant' value='{}'/>",
                       names[static_cast<std::size_t>(v.variant)]) +
           in_file(parameter::Number{}, "alpha_u", v.alpha_u.constant) +
           in_file(parameter::Number{}, "alpha_v", v.alpha_v.constant);
}

// A value with one of its numbers changed, for each of them.

inline std::vector<double> varied(double v) { return {v * 1.0625}; }
inline std::vector<Textured<double>> varied(const Textured<double>& v) {
    return {Textured<double>(v.constant * 1.0625)};
}
inline std::vector<bool> varied(bool v) { return {!v}; }
inline std::vector<Rgb> varied(const Textured<Rgb>& color) {
    std::vector<Rgb> colors(3, color.constant);
    for (int channel = 0; channel < 3; channel++)
        colors[channel][channel] *= 1.0625;
    return colors;
}
inline std::vector<parameter::ComplexIndex::Value> varied(const parameter::ComplexIndex::Value& v) {
    std::vector<parameter::ComplexIndex::Value> values;
    for (const Rgb& eta : varied(v.eta))
        values.push_back({eta, v.k});
    for (const Rgb& k : varied(v.k))
        values.push_back({v.eta, k});
    return values;
}
inline std::vector<parameter::EvenRoughness::Value>
varied(const parameter::EvenRoughness::Value& v) {
    return {{MicrofacetDistribution::beckmann, v.alpha}, {v.distribution, v.alpha * 1.0625}};
}
inline std::vector<parameter::Roughness::Value> varied(const parameter::Roughness::Value& v) {
    return {{MicrofacetDistribution::beckmann, v.alpha_u, v.alpha_v},
            {v.distribution, v.alpha_u.constant * 1.0625, v.alpha_v},
            {v.distribution, v.alpha_u, v.alpha_v.constant * 1.0625}};
}
inline std::vector<parameter::WardRoughness::Value>
varied(const parameter::WardRoughness::Value& v) {
    return {{WardVariant::balanced, v.alpha_u, v.alpha_v},
            {WardVariant::ward_duer, v.alpha_u, v.alpha_v},
            {v.variant, v.alpha_u.constant * 1.0625, v.alpha_v},
            {v.variant, v.alpha_u, v.alpha_v.constant * 1.0625}};
}

/// A record as lanes see it.
template<class Material>
Material material_of(const MaterialRecord& record) {
    Material m{};
#define COPY_FIELD(type, name) m.name = record.name;
    MATERIAL_FIELDS(COPY_FIELD)
#undef COPY_FIELD
    return m;
}

} // namespace parhelion::test
