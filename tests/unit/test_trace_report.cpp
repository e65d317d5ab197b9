// What is printed of a sample, in the scene's units, against what follows from the other numbers
// that are printed.
#include "host/commands/trace_report.h"
#include "host/numerics/every_kind_scene.h"
#include "tests/support/trace_numbers.h"
#include "tests/support/two_of_every.h"

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include <cmath>

using namespace parhelion;
using namespace parhelion::test;
using namespace parhelion::numerics;
using nlohmann::json;

namespace {

/// What is no finite number is a string.
double number(const json& j) {
    if (!j.is_string()) return j.get<double>();
    return j == "inf" ? INFINITY : j == "-inf" ? -INFINITY : NAN;
}
glm::dvec3 vector(const json& j) { return {number(j[0]), number(j[1]), number(j[2])}; }

/// So bright that it is counted in another unit.
const Rgb radiance(9e14, 8e14, 7e14);

/// One light. Units are not 1.
Scene printed_scene() {
    Scene scene = every_kind_scene();
    scene.integrator.aovs.clear();
    scene.film.width = scene.film.crop_width = 20;
    scene.film.height = scene.film.crop_height = 15;
    scene.film.filter.kind = FilterKind::box;
    scene.emitters.clear();
    for (Shape& shape : scene.shapes)
        shape.radiance.reset();
    scene.shapes.back() =
        shape_of(quad({-2, 2.8, -1}, {4, 0, 0}, {0, 0, 3}), 0, no_material, radiance);
    return scene;
}

/// What has been looked at of a sample.
struct Told {
    glm::dvec3 sum{0};
    int lit = 0;
};

void check_emission(const json& v, Told& told) {
    const json& e = v["emission"];
    if (e.is_null()) return;
    double weight = power_heuristic(number(v["direction_pdf"]), number(e["light_pdf"]));
    CHECK(number(e["mis_weight"]) == Approx(weight));
    told.sum += vector(e["contribution"]);
    glm::dvec3 seen = vector(v["throughput"]) * vector(e["radiance"]) * weight;
    CHECK(glm::length(vector(e["contribution"]) - seen) <= 1e-5 * glm::length(told.sum));
    CHECK((vector(e["radiance"]) == glm::dvec3(0) || near(vector(e["radiance"]), radiance, 1e-6)));
}

void check_light(const json& v, Told& told) {
    const json& l = v["next_event"];
    double pdf = number(l["pdf"]), of_bsdf = number(l["bsdf_pdf"]);
    if (pdf == 0) return; // from behind
    CHECK(number(l["mis_weight"]) == Approx(power_heuristic(pdf, of_bsdf)).epsilon(1e-4));
    CHECK(number(l["pmf"]) == 1);
    CHECK(near(vector(l["radiance_over_pdf"]), radiance / pdf, 1e-5));
    glm::dvec3 towards = vector(l["target"]) - vector(v["position"]);
    if (v["emission"].is_null()) CHECK(near(vector(l["direction"]), glm::normalize(towards), 1e-3));
    glm::dvec3 brought = vector(v["throughput"]) * vector(v["energy_gain"]) * vector(l["bsdf"]) *
                         vector(l["radiance_over_pdf"]) * number(l["mis_weight"]) *
                         number(l["geometry_share"]);
    CHECK(near(vector(l["contribution"]), brought, 1e-5));
    if (l["shadow_ray"] == false || l["blocked"] == true) return;
    CHECK(near(vector(l["arriving"]), vector(l["contribution"]), 0));
    told.sum += vector(l["arriving"]);
    told.lit++;
}

void check_onward(const json& v, const json& next) {
    const json& s = v["scattering"];
    double survived = v["roulette"].is_null() ? 1 : number(v["roulette"]["throughput_scale"]);
    glm::dvec3 after = vector(v["throughput"]) * vector(v["energy_gain"]) * vector(s["weight"]) *
                       number(s["geometry_share"]) * survived;
    CHECK(near(vector(v["throughput_after"]), after, 1e-5));
    CHECK(next["throughput"] == v["throughput_after"]);
    // No surface at all is as if it had not been met.
    bool nothing = v["material"]["kind"] == "null";
    CHECK(next["direction_pdf"] == (nothing ? v["direction_pdf"] : s["pdf"]));
    CHECK(glm::length(vector(next["origin"]) - vector(v["position"])) < 1e-4);
}

void check_vertex(const json& v, Told& told) {
    check_emission(v, told);
    if (v["hit"] == false) return;
    glm::dvec3 there = vector(v["origin"]) + number(v["t"]) * vector(v["direction"]);
    CHECK(glm::length(there - vector(v["position"])) < 1e-4);
    CHECK(number(v["wo"][2]) ==
          Approx(-glm::dot(vector(v["direction"]), vector(v["ns"]))).margin(1e-5));
    if (v["material"].is_null()) return;
    check_light(v, told);
    REQUIRE(v["random"].size() == 2);
    CHECK(v["random"][0]["for"] == "emitter");
    CHECK(v["random"][1]["for"] == "bsdf");
}

} // namespace

TEST_CASE("Trace report: what is printed follows from what else is printed", "[trace]") {
    Scene scene = printed_scene();
    DeviceScene flat = make_device_scene(scene);
    int lit = 0;
    CHECK(flat.frame.unit() != 1);
    CHECK(flat.frame.radiance_unit != 1);
    for (int y = 0; y < scene.film.height; y++)
        for (int x = 0; x < scene.film.width; x++) {
            CAPTURE(x, y);
            json trace = trace_json(scene, flat, trace_sample(scene, flat, x, y, 1));
            Told told;
            const json& vertices = trace["vertices"];
            for (std::size_t i = 0; i < vertices.size(); i++) {
                CAPTURE(i);
                check_vertex(vertices[i], told);
                CHECK(vertices[i].value("goes_on", false) == (i + 1 < vertices.size()));
                if (i + 1 < vertices.size()) check_onward(vertices[i], vertices[i + 1]);
            }
            CHECK(near(told.sum, vector(trace["radiance"]), 1e-5));
            lit += told.lit;
        }
    CHECK(lit > 200);
}
