// Our own comparison scenes on the device against stored figures of Mitsuba's. The level of all
// tests together is 1 %; seeds are fixed, so that a run does not differ from the last.
#include "tests/support/mitsuba_figures.h"
#include "tests/support/render_scene.h"

using namespace parhelion;
using namespace parhelion::test::mitsuba_figures;

namespace {

constexpr double family_level = 0.01;

Effort effort() {
    return {32, 32, [](const Scene& scene) { return test::render_quietly(scene); }};
}

} // namespace

TEST_CASE("Pictures are Mitsuba's within the noise of both, region by region", "[render]") {
    check_all_cases(effort(), family_level);
}

TEST_CASE("Figures of Mitsuba's show a grey of 0.51 for 0.5, and a bounce too few", "[render]") {
    json stored = read_json("references.json"), list = read_json("cases.json").at("cases");
    double level = numerics::sidak_level(family_level, figures_in(stored.at("cases")));
    for (const char* name : {"shapes", "twosided_null"}) {
        INFO(name);
        json wrong = case_of_name(list, name);
        json parameters = wrong.value("parameters", json::object());
        parameters.update(wrong.at("wrong"));
        wrong["parameters"] = parameters;
        Verdict v = compare_case(wrong, stored.at("cases").at(name), stored.at("about"), effort());
        CHECK(v.least_p < level);
    }
}
