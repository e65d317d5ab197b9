// Suns and skies in files: what parameters mean in Mitsuba 3 and before, where the sun stands by
// date and place, and what is refused.
#include "host/scene/mitsuba/sun_position.h"
#include "test_scene_tools.h"

#include <catch2/catch.hpp>
#include <fmt/format.h>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

using namespace parhelion;
using namespace parhelion::test;
using namespace parhelion::mitsuba;
using Catch::Contains;

namespace {

std::string plugin(const std::string& type, const std::string& inside) {
    return fmt::format("<emitter type='{}'>\n{}</emitter>", type, inside);
}
SunskyEmitter sunsky(const std::string& inside) {
    return std::get<SunskyEmitter>(load_body(plugin("sunsky", inside)).emitters.at(0));
}
SunskyEmitter old(const std::string& type, const std::string& inside) {
    return std::get<SunskyEmitter>(load_body(plugin(type, inside), "0.6.0").emitters.at(0));
}
std::string refusal(const std::string& body, const std::string& version = "3.0.0") {
    const SceneFolder folder;
    return refusal_of(folder.write("scene.xml", scene_text(body, version)));
}
std::string number(const char* name, double value) {
    return fmt::format("<float name='{}' value='{}'/>", name, value);
}
/// In the world.
glm::dvec3 sun_of(const SunskyEmitter& e) { return e.to_world * e.sun; }
glm::dvec3 up_of(const SunskyEmitter& e) { return e.to_world[1]; }

double degrees_apart(const glm::dvec3& a, const glm::dvec3& b) {
    return glm::degrees(2 * std::asin(0.5 * glm::length(a - b)));
}

/// The parameter "sun_direction" of Mitsuba 3.9.1, whose days are single precision: whole quarters.
/// At these times (0, 6, 12, 18 hours universal) they are what they are.
struct PlaceFigure {
    TimeAndPlace at;
    double direction[3];
};
// clang-format off
constexpr PlaceFigure place_figures[] = {
    {{2010, 7, 10, 15, 0, 0, 35.6894, 139.6917, 9}, {0.0513854474, 0.691747963, 0.720308483}},
    {{2024, 3, 1, 18, 0, 0, -33.9, 18.4, 6}, {-0.428215802, 0.262532711, 0.864701033}},
    {{1999, 12, 31, 12, 0, 0, 10, -66, 0}, {0.449673921, -0.84479326, 0.290030718}},
    {{2001, 1, 1, 7, 0, 0, 60, 25, 1}, {0.521052063, -0.84019798, -0.150239855}},
    {{2010, 2, 28, 19, 30, 0, -10, 100, 7.5}, {0.155892432, 0.983409286, -0.0927563012}},
    {{2024, 2, 29, 11, 0, 0, 20, -75, -1}, {0.195300341, -0.969769061, 0.14630726}},
};
// clang-format on

std::string in_file(const TimeAndPlace& t) {
    return fmt::format("<integer name='year' value='{}'/><integer name='month' value='{}'/>"
                       "<integer name='day' value='{}'/>",
                       t.year, t.month, t.day) +
           number("hour", t.hour) + number("minute", t.minute) + number("second", t.second) +
           number("latitude", t.latitude) + number("longitude", t.longitude) +
           number("timezone", t.timezone);
}

} // namespace

TEST_CASE("Daylight files: a sunsky of Mitsuba 3") {
    SunskyEmitter e = sunsky("");
    CHECK(e.turbidity == 3);
    CHECK(e.albedo == Rgb(0.3));
    CHECK((e.sun_scale == 1 && e.sky_scale == 1));
    CHECK(glm::degrees(2 * e.half_aperture) == Approx(0.5358));
    CHECK(up_of(e) == glm::dvec3(0, 0, 1));
    SunskyEmitter other =
        sunsky(number("turbidity", 5.5) + number("sun_scale", 0.5) + number("sky_scale", 2) +
               number("sun_aperture", 3) + number("sampling_weight", 1) +
               "<rgb name='albedo' value='0.1, 0.2, 1'/>"
               "<boolean name='complex_sun' value='false'/>"
               "<vector name='sun_direction' x='3' y='0' z='4'/>");
    CHECK(other.turbidity == 5.5);
    CHECK(other.albedo == Rgb(0.1, 0.2, 1));
    CHECK((other.sun_scale == 0.5 && other.sky_scale == 2));
    CHECK(glm::degrees(2 * other.half_aperture) == Approx(3));
    CHECK(degrees_apart(sun_of(other), {0.6, 0, 0.8}) < 1e-6);
    CHECK(load_body(plugin("sunsky", "")).notes.empty());
}

TEST_CASE("Daylight files: the sun stands where Mitsuba 3 has it") {
    for (const PlaceFigure& f : place_figures) {
        CAPTURE(f.at.year, f.at.month, f.at.day);
        glm::dvec3 truth(f.direction[0], f.direction[1], f.direction[2]);
        CHECK(degrees_apart(sun_of(sunsky(in_file(f.at))), truth) < 2e-3);
    }
    // Turned with its sky: of x turned to y, and of no other length.
    TimeAndPlace at = place_figures[0].at;
    SunskyEmitter turned = sunsky(in_file(at) + "<transform name='to_world'><scale value='3'/>"
                                                "<rotate z='1' angle='90'/></transform>");
    CHECK(degrees_apart(sun_of(turned), {-0.691747963, 0.0513854474, 0.720308483}) < 2e-3);
    // A direction is one of the world, whatever turns the sky.
    SunskyEmitter tilted = sunsky("<vector name='sun_direction' x='0' y='3' z='0'/><transform "
                                  "name='to_world'><rotate x='1' angle='-90'/></transform>");
    CHECK(degrees_apart(tilted.sun, {0, 1, 0}) < 1e-6);
    CHECK(degrees_apart(up_of(tilted), {0, 1, 0}) < 1e-6);
}

TEST_CASE("Daylight files: the sun's place is that of an almanac") {
    // Reda and Andreas 2008, "Solar position algorithm", table A5.1, without refraction.
    SunPosition sun = sun_position({2003, 10, 17, 12, 30, 30, 39.742476, -105.1786, -7});
    CHECK(glm::degrees(sun.zenith) == Approx(90 - 39.872046).margin(0.01));
    CHECK(glm::degrees(sun.azimuth) - 194.340241 + 360 == Approx(0).margin(0.02));
    // At noon in June it stands over the tropic of Cancer.
    SunPosition noon = sun_position({2010, 6, 21, 12, 1, 46, 23.44, 0, 0});
    CHECK(glm::degrees(noon.zenith) < 0.05);
    // In the morning east, in the evening west.
    CHECK(std::sin(sun_position({2010, 3, 20, 7, 0, 0, 50, 0, 0}).azimuth) > 0.9);
    CHECK(std::sin(sun_position({2010, 3, 20, 17, 0, 0, 50, 0, 0}).azimuth) < -0.9);
}

TEST_CASE("Daylight files: suns and skies of Mitsuba 0.x have y up") {
    SunskyEmitter e = old("sunsky", "");
    CHECK(e.albedo == Rgb(0.2));
    CHECK(up_of(e) == glm::dvec3(0, 1, 0));
    // North is -z there, and east x: at 3 pm in July the sun of Tokyo stands in the west-southwest.
    CHECK(degrees_apart(sun_of(e), {-0.691747963, 0.720308483, 0.0513854474}) < 2e-3);
    SunskyEmitter set =
        old("sunsky", number("scale", 3) + number("sunScale", 10) + number("sunRadiusScale", 18) +
                          "<vector name='sunDirection' x='-0.865804' y='0.416766' z='-0.276929'/>"
                          "<transform name='toWorld'><rotate x='1' angle='90'/></transform>");
    CHECK((set.sun_scale == 10 && set.sky_scale == 3));
    CHECK(glm::degrees(2 * set.half_aperture) == Approx(18 * 0.5358));
    CHECK(degrees_apart(sun_of(set), {-0.865804, 0.416766, -0.276929}) < 1e-3);
    CHECK(degrees_apart(up_of(set), {0, 0, 1}) < 1e-6);
    SunskyEmitter sun = old("sun", number("scale", 8) + number("turbidity", 4));
    CHECK((sun.sun_scale == 8 && sun.sky_scale == 0 && sun.turbidity == 4));
    SunskyEmitter sky = old("sky", number("scale", 7) + number("stretch", 1));
    CHECK((sky.sun_scale == 0 && sky.sky_scale == 7));
    CHECK(old("sun", number("sunRadiusScale", 0)).half_aperture > 0); // as good as parallel
}

TEST_CASE("Daylight files: what is not as Mitsuba 0.x has it is noted") {
    auto notes = [](const std::string& type, const std::string& inside) {
        return load_body(plugin(type, inside), "0.6.0").notes;
    };
    for (const char* type : {"sunsky", "sun", "sky"}) {
        std::vector<std::string> plain = notes(type, "");
        REQUIRE(plain.size() == 1);
        CHECK_THAT(plain[0], Contains("scene.xml:2") && Contains(type) && Contains("Preetham"));
    }
    std::vector<std::string> baked = notes("sky", "<integer name='resolution' value='64'/>\n");
    REQUIRE(baked.size() == 2);
    CHECK_THAT(baked[0], Contains("scene.xml:3") && Contains("resolution"));
    Scene night = load_body(plugin("sunsky", number("hour", 2)));
    REQUIRE(night.notes.size() == 1);
    CHECK_THAT(night.notes[0], Contains("scene.xml:2") && Contains("below the horizon"));
}

TEST_CASE("Daylight files: what is refused is refused with its line") {
    auto refused = [](const std::string& inside, const std::string& what) {
        CHECK_THAT(refusal(plugin("sunsky", inside)), Contains("scene.xml:3") && Contains(what));
    };
    refused(number("turbidity", 0.9), "1 to 10");
    refused(number("turbidity", 10.5), "1 to 10");
    refused("<rgb name='albedo' value='0.5, 1.1, 0'/>", "albedo");
    refused(number("sun_scale", -1), "sun_scale");
    refused(number("sun_aperture", 0), "sun_aperture");
    refused(number("sun_aperture", 180), "less than 180 degrees");
    refused("<boolean name='complex_sun' value='true'/>", "complex_sun");
    refused("<vector name='sun_direction' x='0' y='0' z='0'/>", "without a direction");
    refused("<vector name='sun_direction' x='0' y='0' z='1'/>\n" + number("hour", 3),
            "given together with \"hour\"");
    refused("<transform name='to_world'><scale x='2'/></transform>", "deforms the sky");
    refused(number("scale", 2), "scale");
    refused(number("sunScale", 2), "sunScale");
    CHECK_THAT(refusal(plugin("sun", "")), Contains("scene.xml:2") && Contains("before version 2"));
    CHECK_THAT(refusal(plugin("sky", "")), Contains("scene.xml:2") && Contains("sun_scale"));
    CHECK_THAT(refusal(plugin("timed_sunsky", "")), Contains("timed_sunsky"));
    CHECK_THAT(refusal(plugin("sunsky", "") + plugin("sunsky", "")),
               Contains("a second emitter around the whole scene"));
    auto old_refused = [](const std::string& type, const std::string& inside,
                          const std::string& what) {
        CHECK_THAT(refusal(plugin(type, inside), "0.6.0"),
                   Contains("scene.xml:3") && Contains(what));
    };
    old_refused("sky", number("stretch", 1.5), "stretch");
    old_refused("sunsky", "<boolean name='extend' value='true'/>", "extend");
    old_refused("sun", number("skyScale", 2), "skyScale");
    old_refused("sunsky", "<vector name='sunColor' x='1' y='1' z='1'/>", "sunColor");
}
