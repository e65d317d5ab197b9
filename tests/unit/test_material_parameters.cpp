// Every parameter of every material of the list: what a file says is what the device gets, what it
// leaves out is what Mitsuba's documentation says, and each number makes a difference. A parameter
// without its truth here does not compile.
#include "host/flatten/energy_table.h"
#include "host/flatten/kind_names.h"
#include "host/flatten/material_records.h"
#include "host/numerics/measure.h"
#include "test_scene_tools.h"
#include "tests/support/parameter_values.h"

#include <cstring>

using namespace parhelion;
using namespace parhelion::test;
using namespace parhelion::numerics;

namespace {

/// The words of a record, in double: nothing but reflectance and roughness of 1 where no parameter
/// says otherwise.
struct Words {
#define DOUBLE_FIELD(type, name) double name = 0;
    MATERIAL_FIELDS(DOUBLE_FIELD)
#undef DOUBLE_FIELD
    Words() { r = g = b = alpha_u = alpha_v = 1; }
};

// What each parameter is to the device, by its name.

void expect_reflectance(Words& w, const Textured<Rgb>& color) {
    const Rgb& c = color.constant;
    w.r = c.r, w.g = c.g, w.b = c.b;
}
void expect_specular_reflectance(Words& w, const Textured<Rgb>& c) { expect_reflectance(w, c); }
void expect_specular_transmittance(Words& w, const Textured<Rgb>& color) {
    const Rgb& c = color.constant;
    w.tr = c.r, w.tg = c.g, w.tb = c.b;
}
void expect_index(Words& w, const parameter::ComplexIndex::Value& v) {
    const Rgb &eta = v.eta.constant, &k = v.k.constant;
    w.er = eta.r, w.eg = eta.g, w.eb = eta.b;
    w.kr = k.r, w.kg = k.g, w.kb = k.b;
}
/// eta^2 - 1 from outside and from inside, in two floats each.
void expect_eta(Words& w, double eta) {
    double outside = eta * eta - 1, inside = 1 / (eta * eta) - 1;
    w.er = eta, w.eg = 1 / eta;
    w.eb = static_cast<float>(outside), w.kr = outside - w.eb;
    w.kg = static_cast<float>(inside), w.kb = inside - w.kg;
}
void expect_roughness(Words& w, const parameter::Roughness::Value& v) {
    w.distribution = v.distribution == MicrofacetDistribution::beckmann ? 1 : 0;
    w.alpha_u = v.alpha_u.constant, w.alpha_v = v.alpha_v.constant;
}
void expect_roughness(Words& w, const parameter::EvenRoughness::Value& v) {
    w.distribution = v.distribution == MicrofacetDistribution::beckmann ? 1 : 0;
    w.alpha_u = w.alpha_v = v.alpha;
}
void expect_alpha(Words& w, double alpha) { w.alpha_u = alpha; }
void expect_exponent(Words& w, const Textured<double>& v) { w.alpha_u = v.constant; }
void expect_roughness(Words& w, const parameter::WardRoughness::Value& v) {
    w.kr = v.variant == WardVariant::ward ? 1 : v.variant == WardVariant::ward_duer ? 2 : 0;
    w.alpha_u = v.alpha_u.constant, w.alpha_v = v.alpha_v.constant;
}
void expect_eta(Words& w, const Textured<double>& eta) { w.er = eta.constant; }
void expect_base_color(Words& w, const Textured<Rgb>& color) { expect_reflectance(w, color); }
void expect_roughness(Words& w, const Textured<double>& v) { w.alpha_u = v.constant; }
void expect_anisotropic(Words& w, const Textured<double>& v) { w.alpha_v = v.constant; }
void expect_metallic(Words& w, const Textured<double>& v) { w.tr = v.constant; }
void expect_spec_trans(Words& w, const Textured<double>& v) { w.tg = v.constant; }
void expect_spec_tint(Words& w, const Textured<double>& v) { w.tb = v.constant; }
void expect_sheen(Words& w, const Textured<double>& v) { w.eg = v.constant; }
void expect_sheen_tint(Words& w, const Textured<double>& v) { w.eb = v.constant; }
void expect_flatness(Words& w, const Textured<double>& v) { w.kr = v.constant; }
void expect_clearcoat(Words& w, const Textured<double>& v) { w.kg = v.constant; }
void expect_clearcoat_gloss(Words& w, const Textured<double>& v) { w.kb = v.constant; }
void expect_diff_trans(Words& w, const Textured<double>& v) { w.kg = v.constant; }
void expect_diffuse_reflectance(const Words&, const Textured<Rgb>&) {}
void expect_nonlinear(const Words&, bool) {}
void expect_energy_compensation(const Words&, bool) {}
void expect_ensure_energy_conservation(const Words&, bool) {}

// What several parameters become together.

void expect_together(const Words&, const auto&) {}
/// The reflectance, averaged over the cosine: 2 c F(c) dc, by the rectangle rule.
void expect_together(Words& w, const RoughConductorBsdf& b) {
    double sums[3] = {};
    constexpr int steps = 20000;
    for (int i = 0; i < steps; i++)
        for (int channel = 0; channel < 3; channel++) {
            double c = (i + 0.5) / steps;
            sums[channel] += 2 * c / steps *
                             f64::fresnel_conductor(c, b.index.eta.constant[channel],
                                                    b.index.k.constant[channel]);
        }
    const Rgb& scale = b.specular_reflectance.constant;
    w.tr = sums[0] * scale.r, w.tg = sums[1] * scale.g, w.tb = sums[2] * scale.b;
}

/// What the coat sends back inside, averaged over the cosine likewise: all beyond the critical
/// angle.
void expect_coat(Words& w, const auto& b) {
    expect_reflectance(w, b.diffuse_reflectance);
    expect_specular_transmittance(w, b.specular_reflectance);
    double back = 0;
    constexpr int steps = 200000;
    for (int i = 0; i < steps; i++) {
        double c = (i + 0.5) / steps;
        back +=
            2 * c / steps * f64::fresnel_dielectric(c, interface_of<F64>(1 / b.eta)).reflectance;
    }
    w.kg = b.nonlinear ? -back : back, w.kb = 0;
}
void expect_together(Words& w, const PlasticBsdf& b) { expect_coat(w, b); }
/// Of a rough one what tables say is not there yet: it lets everything through.
void expect_together(Words& w, const RoughPlasticBsdf& b) {
    expect_coat(w, b);
    w.kb = w.eg = 1;
}

/// Mitsuba 0.6's manual and its warning: where a component of their sum is above 1 both
/// reflectances are scaled, by 0.99 over the largest.
void expect_limited(Words& w, const auto& b) {
    expect_reflectance(w, b.diffuse_reflectance);
    expect_specular_transmittance(w, b.specular_reflectance);
    double most = std::max({w.r + w.tr, w.g + w.tg, w.b + w.tb});
    if (!b.ensure_energy_conservation || most <= 1) return;
    for (double* word : {&w.r, &w.g, &w.b, &w.tr, &w.tg, &w.tb})
        *word *= 0.99 / most;
}
void expect_together(Words& w, const PhongBsdf& b) { expect_limited(w, b); }
void expect_together(Words& w, const WardBsdf& b) { expect_limited(w, b); }

/// Not an interface, whose eta has several words; opaque where spec_trans is 0.
void expect_together(Words& w, const PrincipledBsdf& b) {
    Words none;
    none.kind = w.kind, none.r = w.r, none.g = w.g, none.b = w.b;
    none.alpha_u = w.alpha_u, none.alpha_v = w.alpha_v;
    none.tr = b.metallic.constant, none.tg = b.spec_trans.constant, none.tb = b.spec_tint.constant;
    none.er = b.eta, none.eg = b.sheen.constant, none.eb = b.sheen_tint.constant;
    none.kr = b.flatness.constant, none.kg = b.clearcoat.constant;
    none.kb = b.clearcoat_gloss.constant;
    none.distribution = b.spec_trans.constant == 0 ? 1 : 0;
    w = none;
}

#define EXPECT_PARAMETER(Kind, name, ...) expect_##name(w, b.name);
#define EXPECT_BSDF(name, Name, ...)                                                               \
    Words expected_words([[maybe_unused]] const Name##Bsdf& b) {                                   \
        Words w;                                                                                   \
        w.kind = material_##name;                                                                  \
        PARAMETERS_##name(EXPECT_PARAMETER);                                                       \
        expect_together(w, b);                                                                     \
        return w;                                                                                  \
    }
MATERIALS(EXPECT_BSDF)

void check_record(const MaterialRecord& found, const Words& expected) {
#define CHECK_WORD(type, name)                                                                     \
    {                                                                                              \
        INFO(#name);                                                                               \
        CHECK(double(found.name) == Approx(expected.name).epsilon(1e-6).margin(1e-13));            \
    }
    MATERIAL_FIELDS(CHECK_WORD)
#undef CHECK_WORD
    CHECK(found.alpha_u == static_cast<float>(expected.alpha_u));
    CHECK(found.alpha_v == static_cast<float>(expected.alpha_v));
}

/// High and low parts of eta^2 - 1 make one number, to double's precision.
void check_interface(const MaterialRecord& found, double eta) {
    CHECK(double(found.eb) + found.kr == Approx(eta * eta - 1).epsilon(1e-13));
    CHECK(double(found.kg) + found.kb == Approx(1 / (eta * eta) - 1).epsilon(1e-13));
}

// What Mitsuba 3's documentation gives a parameter that is missing; of `roughdiffuse`, `phong` and
// `ward` Mitsuba 0.6's. No metal is named: it reflects everything.

Rgb missing_reflectance(const auto&) { return Rgb(0.5); }
Rgb missing_diffuse_reflectance(const auto&) { return Rgb(0.5); }
bool missing_nonlinear(const auto&) { return false; }
Rgb missing_specular_reflectance(const auto&) { return Rgb(1.0); }
Rgb missing_specular_reflectance(const PhongBsdf&) { return Rgb(0.2); }
Rgb missing_specular_reflectance(const WardBsdf&) { return Rgb(0.2); }
double missing_exponent(const auto&) { return 30; }
bool missing_ensure_energy_conservation(const auto&) { return true; }
Rgb missing_specular_transmittance(const auto&) { return Rgb(1.0); }
parameter::ComplexIndex::Value missing_index(const auto&) { return {Rgb(0.0), Rgb(1.0)}; }
double missing_eta(const PlasticBsdf&) { return 1.49 / 1.000277; } // "polypropylene" in "air"
double missing_eta(const RoughPlasticBsdf&) { return 1.49 / 1.000277; }
double missing_eta(const PrincipledBsdf&) { return 1.5; } // specular 0.5
double missing_eta(const PrincipledThinBsdf&) { return 1.5; }
Rgb missing_base_color(const auto&) { return Rgb(0.5); }
double missing_roughness(const PrincipledBsdf&) { return 0.5; }
double missing_roughness(const PrincipledThinBsdf&) { return 0.5; }
double missing_anisotropic(const auto&) { return 0; }
double missing_metallic(const auto&) { return 0; }
double missing_spec_trans(const auto&) { return 0; }
double missing_spec_tint(const auto&) { return 0; }
double missing_sheen(const auto&) { return 0; }
double missing_sheen_tint(const auto&) { return 0; }
double missing_flatness(const auto&) { return 0; }
double missing_clearcoat(const auto&) { return 0; }
double missing_clearcoat_gloss(const auto&) { return 0; }
double missing_diff_trans(const auto&) { return 0; }
double missing_eta(const auto&) { return 1.5046 / 1.000277; } // "bk7" in "air"
parameter::EvenRoughness::Value missing_roughness(const RoughPlasticBsdf&) {
    return {MicrofacetDistribution::beckmann, 0.1};
}
parameter::WardRoughness::Value missing_roughness(const WardBsdf&) {
    return {WardVariant::balanced, 0.1, 0.1};
}
parameter::Roughness::Value missing_roughness(const auto&) {
    return {MicrofacetDistribution::beckmann, 0.1, 0.1};
}
double missing_alpha(const RoughDiffuseBsdf&) { return 0.2; }
bool missing_energy_compensation(const auto&) { return true; } // docs: ours, on

#define MISSING_PARAMETER(Kind, name, ...) b.name = missing_##name(b);
#define MISSING_BSDF(name, Name, ...)                                                              \
    void set_missing([[maybe_unused]] Name##Bsdf& b) { PARAMETERS_##name(MISSING_PARAMETER) }
MATERIALS(MISSING_BSDF)

/// Of a ball of `bsdf`, its parameters written out or left out.
Bsdf loaded(const Bsdf& bsdf, bool written) {
    std::string text;
    auto write = [&](auto kind, const char* name, const auto& value) {
        text += in_file(kind, name, value);
    };
    if (written) std::visit([&](const auto& b) { each_parameter(b, write); }, bsdf);
    Scene scene = load_body(fmt::format("<shape type='sphere'><bsdf type='{}'>{}</bsdf></shape>",
                                        material_names[bsdf.index()], text));
    REQUIRE(scene.materials.size() == 1);
    return scene.materials[0].bsdf;
}

void check_loaded(const Bsdf& expected, bool written) {
    CAPTURE(material_names[expected.index()], written);
    Bsdf found = loaded(expected, written);
    REQUIRE(found.index() == expected.index());
    std::visit([&](const auto& b) { check_record(material_record(found), expected_words(b)); },
               expected);
    std::visit(
        [&](const auto& b) {
            constexpr bool coat = requires { b.nonlinear; };
            constexpr bool burleys = requires { b.base_color; };
            if constexpr (!coat && !burleys && requires { b.eta; })
                check_interface(material_record(found), b.eta);
        },
        expected);
    CHECK(wants_energy_compensation(found) == wants_energy_compensation(expected));
}

/// Whether the device, or the host that makes energy tables, sees that two are not the same.
bool differ(const Bsdf& a, const Bsdf& b) {
    if (wants_energy_compensation(a) != wants_energy_compensation(b)) return true;
    auto m = material_of<f32::Material>(material_record(a)),
         n = material_of<f32::Material>(material_record(b));
    Random random(7);
    for (int k = 0; k < 200; k++) {
        f32::vec3 wo = random.direction<F32>(), wi = random.direction<F32>();
        f32::BsdfEval e = bsdf_eval(m, wo, wi), f = bsdf_eval(n, wo, wi);
        f32::vec2 u = random.square<F32>();
        auto lobe = static_cast<float>(random.unit());
        f32::BsdfSample s = bsdf_sample(m, wo, u, lobe), t = bsdf_sample(n, wo, u, lobe);
        if (std::memcmp(&e, &f, sizeof e) != 0 || std::memcmp(&s, &t, sizeof s) != 0) return true;
    }
    return false;
}

} // namespace

TEST_CASE("Material parameters: the device gets what a file says", "[truths]") {
    for (const Bsdf& bsdf : every_unlike_bsdf())
        check_loaded(bsdf, true);
}

TEST_CASE("Material parameters: what is missing is what the documentation says", "[truths]") {
    for (Bsdf bsdf : every_unlike_bsdf()) {
        std::visit([](auto& b) { set_missing(b); }, bsdf);
        check_loaded(bsdf, false);
    }
}

TEST_CASE("Material parameters: each number makes a difference", "[truths]") {
    for (const Bsdf& base : every_unlike_bsdf()) {
        CHECK_FALSE(differ(base, base));
        Bsdf changed = base;
        auto check = [&](auto, const char* name, auto& value) {
            const auto values = varied(value);
            const auto before = value;
            for (std::size_t number = 0; number < values.size(); number++) {
                CAPTURE(material_names[base.index()], name, number);
                value = values[number];
                CHECK(differ(base, changed));
            }
            value = before;
        };
        std::visit([&](auto& b) { each_parameter(b, check); }, changed);
    }
}
