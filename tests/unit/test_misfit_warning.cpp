// The warning of values that a written file does not hold: counts, places, and what is there
// instead.
#include "host/commands/misfit_warning.h"

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include <cmath>

using namespace parhelion;
using Catch::Contains;

namespace {

RenderReport report_of(int channels) {
    RenderReport report;
    for (int c = 0; c < channels; c++) {
        Misfits m{.channel = "layer" + std::to_string(c) + ".R"};
        m.add(3 + c, 5, INFINITY, false);
        m.add(9, 9, NAN, false);
        m.add(9, 10, 1e5f, true);
        report.misfits.push_back(m);
    }
    return report;
}

} // namespace

TEST_CASE("Misfits: none, none told") {
    CHECK(misfit_warning("a.exr", {}, RenderReport{}).empty());
}

TEST_CASE("Misfits: how many, in which layers, where the first of each is") {
    ExrOptions written;
    written.component = ComponentFormat::float16;
    std::string text = misfit_warning("a.exr", written, report_of(2));
    CHECK_THAT(text, Contains("a.exr: 4 values of the image are not finite") &&
                         Contains("a.exr: 2 values are beyond float16 (65504)") &&
                         Contains("infinite in the file") &&
                         Contains("layer0.R: 3 values, the first at pixel 3,5: inf") &&
                         Contains("layer1.R: 3 values, the first at pixel 4,5: inf") &&
                         !Contains("--stats"));
    CHECK(text.back() != '\n');
    CHECK_THAT(misfit_warning("a.exr", written, report_of(9)),
               Contains("5 channels more (--stats"));
    written.component = ComponentFormat::uint32;
    CHECK_THAT(misfit_warning("a.exr", written, report_of(1)), Contains("beyond uint32"));
    CHECK_THAT(misfit_warning("a.png", written, report_of(1)), Contains("shown in magenta"));
}

TEST_CASE("Misfits: of layers of different components, what is said is of that which did not fit") {
    ExrOptions written;
    written.layers["layer0"] = ComponentFormat::float16;
    CHECK_THAT(misfit_warning("a.exr", written, report_of(1)), Contains("beyond float16 (65504)"));
}

TEST_CASE("Misfits: the report for scripts has each channel") {
    nlohmann::json json = to_json(report_of(2));
    CHECK(json["counts"]["misfits"] == 6);
    REQUIRE(json["misfits"].size() == 2);
    const nlohmann::json& second = json["misfits"][1];
    CHECK(second["channel"] == "layer1.R");
    CHECK(second["not_finite"] == 2);
    CHECK(second["out_of_range"] == 1);
    CHECK(second["first"] == nlohmann::json{{"pixel_x", 4}, {"pixel_y", 5}, {"value", "inf"}});
}
