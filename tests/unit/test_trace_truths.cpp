// A sample told vertex by vertex, against what follows from its own other numbers: weights by
// Veach's power heuristic, light and throughput by the rendering equation, random numbers as those
// of the decision that they are said to be for.
#include "host/flatten/aov_plan.h"
#include "host/numerics/energy.h"
#include "host/numerics/every_kind_scene.h"
#include "host/numerics/light_tables.h"
#include "host/twin/sample_trace.h"
#include "tests/support/parameter_values.h"
#include "tests/support/trace_numbers.h"
#include "tests/support/two_of_every.h"

#include <catch2/catch.hpp>

#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <string_view>

using namespace parhelion;
using namespace parhelion::test;
using namespace parhelion::numerics;

namespace {

glm::dvec3 vector(const Triple& t) { return {t[0], t[1], t[2]}; }
f64::vec3 wide(const glm::dvec3& v) { return f64::v3(v.x, v.y, v.z); }
f32::vec3 narrow(const Triple& t) { return {t[0], t[1], t[2]}; }
glm::dvec3 vector(const f64::vec3& v) { return {v.x, v.y, v.z}; }

/// Every material, emitter and shape, of independent random numbers.
Scene traced_scene(bool one_light) {
    Scene scene = every_kind_scene();
    scene.film.filter.kind = FilterKind::box;
    scene.film.width = scene.film.crop_width = 20;
    scene.film.height = scene.film.crop_height = 15;
    scene.sampler.pattern = SamplePattern::independent;
    scene.integrator.aovs.clear();
    if (!one_light) return scene;
    scene.emitters.clear();
    for (std::size_t last : {1, 2})
        scene.shapes[scene.shapes.size() - last].radiance.reset();
    scene.shapes[scene.shapes.size() - 3].geometry = quad({-2, 2.5, -1}, {4, 0, 0}, {0, 0, 3});
    return scene;
}

/// A sample, one vertex after the other: what is carried from one to the next.
class Checked {
public:
    Checked(const Scene& scene, const DeviceScene& flat, const SampleTrace& trace)
        : scene_(scene), flat_(flat), trace_(trace),
          pixel_stride_(film_layout(scene, plan_aovs(scene)).window.pixel_stride) {}

    /// How often each thing was looked at.
    using Counts = std::map<std::string_view, int>;

    void check(Counts& counts) {
        for (const TraceVertex& v : trace_.vertices) {
            CAPTURE(trace_.x, trace_.y, trace_.sample, v.bounce);
            check_emission(v, counts);
            check_draws(v, counts);
            if (!v.hit || v.material < 0) continue;
            check_light(v, counts);
            check_scattered(v, counts);
            eta_scale_ *= v.notes.scattered->eta;
            check_going_on(v, counts);
            sum_ += v.shadow_ray && !v.blocked ? vector(v.arriving) : glm::dvec3(0);
        }
        CHECK(near(sum_, vector(trace_.radiance), 1e-5));
    }

private:
    void check_emission(const TraceVertex& v, Counts& counts);
    void check_draws(const TraceVertex& v, Counts& counts);
    void check_light(const TraceVertex& v, Counts& counts);
    void check_scattered(const TraceVertex& v, Counts& counts);
    void check_going_on(const TraceVertex& v, Counts& counts);
    void check_roulette(const TraceVertex& v, double throughput, Counts& counts);

    const MaterialRecord& record(const TraceVertex& v) const { return flat_.materials[v.material]; }
    /// -1 where the surface is turned over.
    double side(const TraceVertex& v) const { return v.wo[2] < 0 && is_opaque(record(v)) ? -1 : 1; }
    f64::vec3 local(const TraceVertex& v, const glm::dvec3& w) const {
        const auto& f = v.notes.surface->frame;
        return f64::v3(glm::dot(w, vector(f[0])), glm::dot(w, vector(f[1])),
                       glm::dot(w, vector(f[2])) * side(v));
    }
    glm::dvec3 world(const TraceVertex& v, const glm::dvec3& w) const {
        const auto& f = v.notes.surface->frame;
        return w.x * vector(f[0]) + w.y * vector(f[1]) + side(v) * w.z * vector(f[2]);
    }
    f64::vec3 viewer(const TraceVertex& v) const {
        return f64::v3(v.wo[0], v.wo[1], v.wo[2] * side(v));
    }
    /// Probability of each light at a vertex; `hint`: of any orientation there.
    double picked(int row, const Triple& p, const Triple& n, bool hint) const {
        if (flat_.lights.size() == 1) return 1;
        return light_probabilities(flat_, narrow(p), narrow(n), hint)[row];
    }
    /// What a rough material makes up for, from the tables in double; 1 of all others.
    glm::dvec3 gain(const TraceVertex& v) const {
        auto m = material_of<f64::Material>(record(v));
        if (f64::energy_table(m) < 0) return glm::dvec3(1);
        return vector(f64::energy_gain(m, tabulated_share(flat_.energy_tables, m, viewer(v))));
    }
    /// Where light comes from wi, on the side of the viewer.
    f64::BsdfEval eval(const TraceVertex& v, f64::vec3 wi) const {
        auto m = material_of<f64::Material>(record(v));
        return bsdf_eval(coated(flat_.energy_tables, m, viewer(v), wi), viewer(v), wi);
    }
    /// Light that the geometry lets count: none where the two normals see it on different sides.
    double counted(const TraceVertex& v, const glm::dvec3& w) const {
        if (record(v).kind == material_null) return 1;
        glm::dvec3 ns = vector(v.notes.surface->ns), ng = vector(v.notes.surface->ng);
        return glm::dot(ns, w) * glm::dot(ng, w) * glm::dot(ns, ng) > 0 ? 1 : 0;
    }

    const Scene& scene_;
    const DeviceScene& flat_;
    const SampleTrace& trace_;
    int pixel_stride_;
    double pdf_ = INFINITY, eta_scale_ = 1;
    Triple scattered_at_{};
    glm::dvec3 throughput_{1}, sum_{0};
};

void Checked::check_emission(const TraceVertex& v, Counts& counts) {
    CHECK(double{v.pdf} == pdf_);
    CHECK(near(vector(v.throughput), throughput_, 0));
    const ShadeNotes& n = v.notes;
    double weight = 1;
    if (n.emission_weight) {
        double of_light = n.emission->pdf;
        if (!v.hit) {
            bool sampled = std::isfinite(pdf_);
            double chosen = sampled ? picked(flat_.sky_light, scattered_at_, {0, 0, 1}, true) : 1;
            of_light = chosen / (4 * std::numbers::pi);
            CHECK(n.emission->pdf == Approx(of_light).epsilon(1e-6));
        }
        weight = power_heuristic(pdf_, of_light);
        CHECK(*n.emission_weight == Approx(weight));
        counts["emission weight"] += weight < 0.99;
    }
    glm::dvec3 emission(0);
    if (n.emission) emission = throughput_ * vector(n.emission->radiance) * weight;
    sum_ += emission;
    // Told as the difference of two sums.
    CHECK(glm::length(vector(v.emission) - emission) <= 1e-5 * glm::length(sum_));
    counts["emission"] += n.emission.has_value();
}

/// What is asked for is the light first, then the direction.
void Checked::check_draws(const TraceVertex& v, Counts& counts) {
    const std::pair<std::string_view, int> asked[] = {{"emitter", f32::draw_emitter},
                                                      {"bsdf", f32::draw_bsdf}};
    REQUIRE(v.notes.draws.size() == std::size(asked));
    for (std::size_t i = 0; i < std::size(asked); i++) {
        auto [name, draw] = asked[i];
        const ShadeNotes::Draw& found = v.notes.draws[i];
        CHECK(found.decision == name);
        f32::Random4 r = f32::random4(trace_.y * pixel_stride_ + trace_.x, trace_.sample,
                                      f32::bounce_set(v.bounce, draw), scene_.sampler.seed);
        CHECK(found.numbers == std::array{r.x, r.y, r.z, r.w});
        counts[name]++;
    }
}

void Checked::check_light(const TraceVertex& v, Counts& counts) {
    const ShadeNotes& n = v.notes;
    CHECK(near(vector(*n.energy_gain), gain(v), 1e-4));
    counts["energy gain"] += gain(v).x > 1.001;
    const auto& [p, ng, ns, frame] = *n.surface;
    bool arrives = n.pick->pmf > 0 && n.light->weight != Triple{};
    if (!arrives) CHECK(!v.shadow_ray);
    if (!arrives) return;
    CHECK(n.pick->pmf == Approx(picked(n.pick->row, p, ns, false)).epsilon(1e-4));
    const LightRecord& light = flat_.lights[n.pick->row];
    glm::dvec3 wi = vector(n.light->wi), radiance(light.r, light.g, light.b);
    double inverse_pdf = n.light->inverse_pdf;
    if (inverse_pdf > 0) CHECK(near(vector(n.light->weight), radiance * inverse_pdf, 1e-5));
    if (!n.light->distant && !n.emission) // at no distance from itself
        CHECK(near(wi, glm::normalize(vector(n.light->target) - vector(p)), 1e-3));
    f64::BsdfEval f = eval(v, local(v, wi));
    CHECK(near(vector(n.towards_light->f), vector(f.f), 1e-2, 1e-6));
    CHECK(n.towards_light->pdf == Approx(f.pdf).epsilon(1e-2).margin(1e-6));
    // Against a path that meets the light, which does not know how this surface lies.
    double of_path = n.pick->pmf / picked(n.pick->row, p, ns, true);
    double weight = 1 / (1 + std::pow(inverse_pdf * of_path * n.towards_light->pdf, 2));
    CHECK(*n.light_weight == Approx(weight).epsilon(1e-3));
    double share = counted(v, wi);
    if (n.light_share) CHECK(*n.light_share == share);
    glm::dvec3 brought = throughput_ * gain(v) * vector(n.towards_light->f) *
                         vector(n.light->weight) * double{*n.light_weight} * share;
    CHECK(near(vector(v.light), brought, 1e-5));
    CHECK(v.shadow_ray == (std::max({brought.x, brought.y, brought.z}) > 0));
    counts["light weight"] += v.shadow_ray && weight < 0.99;
    counts["light of one place"] += v.shadow_ray && inverse_pdf == 0;
}

/// The direction that the noted numbers give, and its weight f cos / pdf.
void Checked::check_scattered(const TraceVertex& v, Counts& counts) {
    const ShadeNotes::Scattered& s = *v.notes.scattered;
    const std::array<unsigned, 4>& r = v.notes.draws[1].numbers;
    Triple wo = v.wo;
    wo[2] *= static_cast<float>(side(v));
    auto m = coated(flat_.energy_tables, material_of<f32::Material>(record(v)), narrow(wo),
                    f32::v3(0, 0, 1));
    f32::BsdfSample drawn =
        bsdf_sample(m, narrow(wo), f32::uniform2(r[0], r[1]), f32::uniform01(r[2]));
    CHECK(near(vector(s.wi), {drawn.wi.x, drawn.wi.y, drawn.wi.z}, 1e-5));
    if (s.pdf == 0) return; // nothing is scattered
    bool crosses = v.wo[2] * side(v) * s.wi[2] < 0;
    bool refracts =
        record(v).kind == material_dielectric || record(v).kind == material_roughdielectric;
    double eta = v.wo[2] > 0 ? double{record(v).er} : 1 / double{record(v).er};
    CHECK(s.eta == Approx(crosses && refracts ? eta : 1));
    counts["refraction"] += crosses && refracts;
    if (std::isinf(s.pdf)) return;
    f64::BsdfEval f = eval(v, wide(vector(s.wi)));
    CHECK(s.pdf == Approx(f.pdf).epsilon(1e-2));
    CHECK(near(vector(s.weight), vector(f.f) / f.pdf, 1e-2, 1e-4));
    counts["scattered"]++;
}

void Checked::check_going_on(const TraceVertex& v, Counts& counts) {
    const ShadeNotes& n = v.notes;
    glm::dvec3 onward = world(v, vector(n.scattered->wi));
    double share = counted(v, onward);
    if (n.scattered_share) CHECK(*n.scattered_share == share);
    glm::dvec3 after = throughput_ * gain(v) * vector(n.scattered->weight) * share;
    double most = std::max({after.x, after.y, after.z});
    check_roulette(v, most, counts);
    if (n.roulette) after *= double{n.roulette->scale};
    CHECK(v.goes_on == (most > 0 && (!n.roulette || n.roulette->alive)));
    if (!v.goes_on) return;
    REQUIRE(&v != &trace_.vertices.back());
    const TraceVertex& next = (&v)[1];
    CHECK(near(vector(v.throughput_after), after, 1e-5));
    CHECK(near(vector(next.direction), onward, 1e-5));
    throughput_ = vector(v.throughput_after);
    // No surface at all is as if it had not been met, for light as well.
    bool nothing = flat_.features.has(feature_clear_shadows) && record(v).kind == material_null;
    if (!nothing) pdf_ = n.scattered->pdf, scattered_at_ = next.origin;
}

/// Mitsuba 3: from edge rr_depth on, with min(max(throughput) eta^2, 0.95).
void Checked::check_roulette(const TraceVertex& v, double throughput, Counts& counts) {
    const ShadeNotes& n = v.notes;
    REQUIRE(n.roulette.has_value() == (v.bounce + 1 >= scene_.integrator.rr_depth));
    if (!n.roulette) return;
    double survival = std::min(0.95, throughput * eta_scale_ * eta_scale_);
    double u = (n.draws[1].numbers[3] >> 8) * 0x1p-24;
    if (std::abs(u - survival) < 1e-5) return;
    CHECK(n.roulette->alive == (u < survival));
    if (n.roulette->alive) CHECK(n.roulette->scale == Approx(1 / survival));
    counts["roulette"]++;
}

Checked::Counts check_traces(const Scene& scene) {
    DeviceScene flat = make_device_scene(scene);
    Checked::Counts counts;
    for (int y = 0; y < scene.film.height; y++)
        for (int x = 0; x < scene.film.width; x++) {
            for (int sample = 0; sample < 16; sample++) {
                SampleTrace trace = trace_sample(scene, flat, x, y, sample);
                Checked(scene, flat, trace).check(counts);
            }
        }
    return counts;
}

void check_enough(Checked::Counts counts, std::initializer_list<std::string_view> things) {
    for (std::string_view thing : things) {
        CAPTURE(thing);
        CHECK(counts[thing] > 40);
    }
}

} // namespace

TEST_CASE("Trace truths: one light, by what each vertex tells alone", "[trace]") {
    check_enough(check_traces(traced_scene(true)),
                 {"emission weight", "emission", "emitter", "bsdf", "light weight", "energy gain",
                  "refraction", "scattered", "roulette"});
}

TEST_CASE("Trace truths: lights of every kind", "[trace]") {
    check_enough(check_traces(traced_scene(false)),
                 {"emission weight", "emission", "emitter", "bsdf", "light weight", "energy gain",
                  "light of one place", "refraction", "scattered", "roulette"});
}
