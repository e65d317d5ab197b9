// Tables of numbers against those of others: the CIE's curves, indices of metals and glasses, the
// matrices between sRGB and XYZ.
#include "host/scene/mitsuba/cie_tables.h"
#include "test_scene_tools.h"

#include <glm/mat3x3.hpp>
#include <nlohmann/json.hpp>

#include <fstream>
#include <numeric>

using namespace parhelion;
using namespace parhelion::test;

namespace {

/// What Mitsuba 3.9.1 says, stored by tests/mitsuba/store_references.py.
nlohmann::json stored(const std::string& part) {
    std::ifstream in(PARHELION_SOURCE_DIR "/tests/mitsuba/references.json");
    REQUIRE(in);
    return nlohmann::json::parse(in).at(part);
}

ConductorBsdf conductor(const std::string& parameters) {
    Scene scene = load_body("<shape type=\"sphere\"><bsdf type=\"conductor\">" + parameters +
                            "</bsdf></shape>");
    return std::get<ConductorBsdf>(scene.materials.at(0).bsdf);
}

double glass_index(const std::string& parameters) {
    Scene scene = load_body("<shape type=\"sphere\"><bsdf type=\"dielectric\">" + parameters +
                            "</bsdf></shape>");
    return std::get<DielectricBsdf>(scene.materials.at(0).bsdf).eta;
}

/// From 380 to 780 nm.
double sum(const mitsuba::CieTable& table) {
    return std::accumulate(table.begin() + 4, table.begin() + 85, 0.0);
}

/// Columns: XYZ of the primaries of ITU-R BT.709 at a luminance that makes their sum D65 white
/// (x 0.31272, y 0.32903: CIE 15, of its tables).
glm::dmat3 xyz_of_primaries() {
    auto xyz = [](double x, double y) { return glm::dvec3(x / y, 1, (1 - x - y) / y); };
    glm::dmat3 primaries(xyz(0.64, 0.33), xyz(0.30, 0.60), xyz(0.15, 0.06));
    glm::dvec3 scale = glm::inverse(primaries) * xyz(0.31272, 0.32903);
    return {primaries[0] * scale.x, primaries[1] * scale.y, primaries[2] * scale.z};
}

} // namespace

TEST_CASE("Tables: the CIE's observer and D65, entry by entry", "[tables]") {
    nlohmann::json rows = stored("observer");
    REQUIRE(rows.size() == mitsuba::cie_x.size());
    for (std::size_t i = 0; i < rows.size(); i++) {
        INFO(mitsuba::cie_first_nm + mitsuba::cie_step_nm * double(i) << " nm");
        CHECK(mitsuba::cie_x[i] == Approx(rows[i][0].get<double>()).epsilon(1e-6));
        CHECK(mitsuba::cie_y[i] == Approx(rows[i][1].get<double>()).epsilon(1e-6));
        CHECK(mitsuba::cie_z[i] == Approx(rows[i][2].get<double>()).epsilon(1e-6));
        // Theirs is scaled.
        CHECK(mitsuba::cie_d65[i] * mitsuba::d65_scale ==
              Approx(rows[i][3].get<double>()).epsilon(1e-6));
    }
}

TEST_CASE("Tables: sums and points that the CIE gives", "[tables]") {
    // CIE 15: the curves have equal sums but for their last digits.
    CHECK(sum(mitsuba::cie_x) == Approx(21.3714).epsilon(5e-5));
    CHECK(sum(mitsuba::cie_y) == Approx(21.3714).epsilon(5e-5));
    CHECK(sum(mitsuba::cie_z) == Approx(21.3715).epsilon(5e-5));
    CHECK(mitsuba::cie_y[39] == 1); // 555 nm
    // D65 is 100 at 560 nm, and its white point is x 0.3127, y 0.3290.
    CHECK(mitsuba::cie_d65[40] == 100);
    glm::dvec3 white(0);
    for (std::size_t i = 0; i < mitsuba::cie_x.size(); i++)
        white += mitsuba::cie_d65[i] *
                 glm::dvec3(mitsuba::cie_x[i], mitsuba::cie_y[i], mitsuba::cie_z[i]);
    double all = white.x + white.y + white.z;
    CHECK(white.x / all == Approx(0.31272).margin(3e-5));
    CHECK(white.y / all == Approx(0.32903).margin(3e-5));
}

TEST_CASE("Tables: every conductor's index", "[tables]") {
    nlohmann::json presets = stored("conductors");
    CHECK(presets.size() >= 38);
    for (const auto& [name, values] : presets.items()) {
        INFO(name);
        ConductorBsdf metal = conductor("<string name=\"material\" value=\"" + name + "\"/>");
        for (int c = 0; c < 3; c++) {
            CHECK(metal.index.eta.constant[c] ==
                  Approx(values[c].get<double>()).epsilon(2e-6).margin(1e-12));
            CHECK(metal.index.k.constant[c] ==
                  Approx(values[3 + c].get<double>()).epsilon(2e-6).margin(1e-12));
        }
    }
}

TEST_CASE("Tables: indices of glasses, liquids and gases by name", "[tables]") {
    // Mitsuba 3's documentation of `dielectric`.
    const std::pair<const char*, double> media[] = {
        {"vacuum", 1.0},      {"helium", 1.000036},        {"hydrogen", 1.000132},
        {"air", 1.000277},    {"carbon dioxide", 1.00045}, {"water", 1.333},
        {"acetone", 1.36},    {"ethanol", 1.361},          {"carbon tetrachloride", 1.461},
        {"glycerol", 1.4729}, {"benzene", 1.501},          {"silicone oil", 1.52045},
        {"bromine", 1.661},   {"water ice", 1.31},         {"fused quartz", 1.458},
        {"pyrex", 1.47},      {"acrylic glass", 1.49},     {"polypropylene", 1.49},
        {"bk7", 1.5046},      {"sodium chloride", 1.544},  {"amber", 1.55},
        {"pet", 1.575},       {"diamond", 2.419}};
    for (const auto& [name, index] : media) {
        INFO(name);
        std::string text = std::string("value=\"") + name + "\"/>";
        CHECK(glass_index("<string name=\"int_ior\" " + text +
                          "<float name=\"ext_ior\" value=\"1\"/>") == Approx(index).epsilon(1e-12));
        CHECK(glass_index("<float name=\"int_ior\" value=\"3\"/><string name=\"ext_ior\" " +
                          text) == Approx(3 / index).epsilon(1e-12));
    }
}

TEST_CASE("Tables: the way from XYZ to sRGB is that of its primaries", "[tables]") {
    // A constant spectrum as an emission has X = Y = Z = its value.
    Scene scene = load_body("<emitter type=\"point\"><spectrum name=\"intensity\" value=\"1\"/>"
                            "</emitter>");
    Rgb found = std::get<PointEmitter>(scene.emitters.at(0)).intensity;
    glm::dvec3 expected = glm::inverse(xyz_of_primaries()) * glm::dvec3(1);
    for (int c = 0; c < 3; c++)
        CHECK(found[c] == Approx(expected[c]).margin(2e-4));
}
