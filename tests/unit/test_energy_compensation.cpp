// Energy compensation: a white furnace is white for every roughness, index and angle; and who gets
// it.
#include <catch2/catch.hpp>
#include <fmt/format.h>

#include <ctime>

#include "host/flatten/device_scene.h"
#include "host/flatten/material_records.h"
#include "host/flatten/scene_features.h"
#include "host/numerics/every_kind_scene.h"

#include "host/numerics/white_furnace.h" // last: its macros have short names

using namespace parhelion;
using namespace parhelion::numerics;

namespace {

/// Power that a sample of the reflection (or the refraction) stands for, in double: weight times
/// the share of Fresnel it is chosen with.
double sampled_power(const f64::Material& m, f64::vec3 wo, double u, double v, bool reflect) {
    auto s = bsdf_sample(m, wo, {u, v}, reflect ? 0.0 : 1 - 0x1p-53);
    if (!(s.pdf > 0) || (s.wi.z * wo.z > 0) != reflect) return 0;
    if (m.kind == material_roughconductor) return s.weight.x;
    double eta = reflect ? 1 : s.eta;
    f64::vec3 h = normalize3(f64::add3(wo, f64::scale3(s.wi, eta)));
    auto f = fresnel_dielectric(std::fabs(dot3(wo, h)), material_interface(m, wo.z > 0));
    return (reflect ? f.reflectance : f.transmittance) * s.weight.x * eta * eta;
}

/// What leaves a lossless surface of single scattering that is lit from everywhere: the sampling
/// routine's own mean.
double mean_of_samples(const MaterialCase& c, f64::vec3 wo, int count) {
    auto m = make_material<F64>(c);
    double sum = 0, u = 0.5, v = 0.5; // Roberts' additive sequence
    for (int n = 0; n < count; n++) {
        u = std::fmod(u + 0.75487766624669276, 1), v = std::fmod(v + 0.56984029099805327, 1);
        sum += sampled_power(m, wo, u, v, true);
        if (c.transparent) sum += sampled_power(m, wo, u, v, false);
    }
    return sum / count;
}

} // namespace

TEST_CASE("Energy compensation: the share of single scattering is that of samples", "[energy]") {
    struct {
        int kind, distribution;
        double alpha, index, degrees;
    } cases[] = {{material_roughconductor, 0, 1, 1, 30},
                 {material_roughconductor, 0, 0.01, 1, 89},
                 {material_roughconductor, 1, 0.1, 1, 85},
                 {material_roughconductor, 1, 1, 1, 0},
                 {material_roughdielectric, 0, 0.5, 1.5, 70},
                 {material_roughdielectric, 0, 1, 1 / 1.5, 85},
                 {material_roughdielectric, 0, 0.7, 1 / 1.1, 89.9},
                 {material_roughdielectric, 1, 0.35, 1 / 1.01, 89.5},
                 {material_roughdielectric, 1, 1, 1 / 1.33, 10},
                 {material_roughdielectric, 1, 0.35, 1.01, 89.5}};
    for (auto& p : cases) {
        MaterialCase c = lossless(p.kind, p.distribution, p.alpha, p.alpha, p.index);
        double theta = p.degrees * M_PI / 180;
        f64::vec3 wo = {std::sin(theta), 0, std::cos(theta)};
        double samples = mean_of_samples(c, wo, 400000);
        INFO(c.name << ", " << p.degrees << " degrees");
        CHECK(single_scattering(side_of(c, true), wo, true) == Approx(samples).epsilon(2e-3));
        CHECK(samples < 1 + 1e-3);
    }
    // The furnace without compensation is dark.
    CHECK(mean_of_samples(lossless(material_roughconductor, 0, 1, 1, 1), {0, 0, 1}, 10000) < 0.32);
}

TEST_CASE("Energy compensation: tables take little time", "[energy]") {
    for (const MaterialCase& c : {lossless(material_roughconductor, 0, 0.3, 0.3, 1.5),
                                  lossless(material_roughdielectric, 1, 0.3, 0.3, 1.5),
                                  lossless(material_roughconductor, 0, 0.1, 0.3, 1.5),
                                  lossless(material_roughdielectric, 1, 0.1, 0.3, 1.5)}) {
        MaterialRecord record = record_of(make_material<F32>(c));
        std::clock_t start = std::clock();
        std::vector<float> tables = energy_tables(record, ENERGY_AZIMUTHS);
        fmt::print("tables of {}: {:.1f} ms of processor time\n", c.name,
                   1e3 * static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC);
        CHECK(tables.size() == std::size_t(1 + c.transparent) * ENERGY_COSINES * ENERGY_AZIMUTHS);
        for (float energy : tables)
            CHECK((energy > 0 && energy < 1.01f));
    }
}

TEST_CASE("Energy compensation: any direction finds a place within the table", "[energy]") {
    Random random(21);
    MaterialCase c = lossless(material_roughdielectric, 0, 1e-3, 1e-3, 1.5);
    c.alpha_v = 1;
    auto m = make_material<F32>(c);
    m.distribution |= 1 << 1;
    const float cosines[] = {0, -0.f, 1, 1 + 1e-6f, -1, 1e-40f, NAN, INFINITY};
    for (float x : cosines)
        for (float y : cosines)
            for (float z : cosines) {
                f32::EnergyPlace p = energy_place(m, {x, y, z});
                int below = p.at - (z < 0 ? ENERGY_COSINES * ENERGY_AZIMUTHS : 0);
                CHECK(below >= 0);
                CHECK(below % ENERGY_COSINES < ENERGY_COSINES - 1);
                CHECK(below / ENERGY_COSINES < ENERGY_AZIMUTHS - 1);
            }
}

TEST_CASE("Energy compensation: metals keep their average reflectance", "[energy]") {
    RoughConductorBsdf white;
    white.specular_reflectance = Rgb(1, 0.5, 0);
    MaterialRecord m = material_record(white); // eta 0, k 1: reflects everything
    CHECK(m.tr == Approx(1).epsilon(1e-6));
    CHECK(m.tg == Approx(0.5).epsilon(1e-6));
    CHECK(m.tb == 0);
    RoughConductorBsdf clear; // hemispherical reflectance of glass, closed form
    clear.index = {Rgb(1.5), Rgb(0)};
    CHECK(material_record(clear).tr == Approx(0.0917779593423512).epsilon(1e-6));
}

TEST_CASE("Energy compensation: only scenes with rough lobes have it, equal ones share tables",
          "[energy]") {
    Scene scene = every_kind_scene();
    scene.materials.push_back(scene.materials[4]); // the rough metal again
    DeviceScene flat = make_device_scene(scene);
    CHECK(flat.features.has(feature_energy_compensation));
    // One of the metal, two of the glass, two of the plastic.
    CHECK(flat.energy_tables.size() == 5u * ENERGY_COSINES * ENERGY_AZIMUTHS);
    CHECK(flat.materials[4].distribution == (1 | 1 << 1));
    CHECK(flat.materials[5].distribution == (0 | 2 << 1));
    CHECK(flat.materials[0].distribution == 0);
    CHECK(flat.materials.back().distribution == flat.materials[4].distribution);
    std::get<RoughConductorBsdf>(scene.materials[4].bsdf).energy_compensation = false;
    CHECK(make_device_scene(scene).materials[4].distribution == 1);

    for (Material& m : scene.materials)
        if (wants_energy_compensation(m.bsdf)) m.bsdf = DiffuseBsdf{};
    flat = make_device_scene(scene);
    CHECK(!flat.features.has(feature_energy_compensation));
    CHECK(flat.energy_tables.empty());

    RoughPlasticBsdf plastic;
    plastic.energy_compensation = false;
    scene.materials[0].bsdf = plastic;
    flat = make_device_scene(scene); // what it lets through, but no scale
    CHECK(!flat.features.has(feature_energy_compensation));
    CHECK(flat.energy_tables.size() == 2u * ENERGY_COSINES * ENERGY_AZIMUTHS);
}
