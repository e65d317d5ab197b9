// What is said of numbers that are mapped, and of those that are accepted but cannot be right to
// the last digit.
#include "host/flatten/camera_record.h"
#include "test_scene_tools.h"

#include <variant>

using namespace parhelion;
using namespace parhelion::test;
using Catch::Matchers::Contains;

namespace {

std::string notes_of(const Scene& scene) {
    std::string all;
    for (const std::string& note : scene.notes)
        all += note + "\n";
    return all;
}

Scene with_roughness(const std::string& plugin, const std::string& parameters) {
    return load_body("<shape type='sphere'><bsdf type='" + plugin + "'>" + parameters +
                     "</bsdf></shape>");
}

std::string number(const std::string& name, const std::string& value) {
    return "<float name='" + name + "' value='" + value + "'/>";
}

std::string camera_notes(const std::string& parameters) {
    const SceneFolder folder;
    return notes_of(
        load_scene(folder.write("scene.xml", "<scene version='3.0.0'><sensor type='perspective'>" +
                                                 parameters + "</sensor></scene>")));
}

} // namespace

TEST_CASE("Domain notes: roughness near 0 is taken as the least that is held", "[domains]") {
    for (const char* alpha : {"0", "1e-12", "1e-320"}) {
        const Scene scene = with_roughness("roughconductor", number("alpha", alpha));
        const auto& metal = std::get<RoughConductorBsdf>(scene.materials.front().bsdf);
        CHECK(metal.roughness.alpha_u == 1e-9);
        CHECK(metal.roughness.alpha_v == 1e-9);
        CHECK_THAT(notes_of(scene), Contains("scene.xml:2") && Contains("taken as 1e-09"));
    }
    const Scene scene = with_roughness("roughdielectric", number("alpha", "1e-9"));
    CHECK(!scene.materials.empty());
    CHECK(notes_of(scene).empty());
}

TEST_CASE("Domain notes: energy compensation of very different roughnesses", "[domains]") {
    const auto notes = [](const char* plugin, const char* u, const char* v, const char* more = "") {
        return notes_of(with_roughness(plugin, number("alpha_u", u) + number("alpha_v", v) + more));
    };
    CHECK(notes("roughconductor", "0.1", "1").empty());
    CHECK(notes("roughconductor", "4", "4").empty());
    CHECK(notes("roughdielectric", "0.03", "0.3").empty());
    CHECK_THAT(notes("roughconductor", "0.09", "1"), Contains("energy compensation"));
    CHECK_THAT(notes("roughconductor", "1.1", "1"), Contains("energy compensation"));
    CHECK_THAT(notes("roughdielectric", "0.2", "0.4"), Contains("energy compensation"));
    CHECK(
        notes("roughconductor", "0.01", "1", "<boolean name='energy_compensation' value='false'/>")
            .empty());
}

TEST_CASE("Domain notes: energy compensation of a coat over what is thinner", "[domains]") {
    const auto notes = [](const char* inside, const char* more) {
        return notes_of(with_roughness("roughplastic", number("int_ior", inside) +
                                                           number("ext_ior", "1.33") + more));
    };
    CHECK(notes("1.34", "").empty());
    CHECK_THAT(notes("1.3", ""), Contains("scene.xml:2") && Contains("energy compensation"));
    CHECK(notes("1.3", "<boolean name='energy_compensation' value='false'/>").empty());
}

TEST_CASE("Domain notes: pixels narrower than directions are told apart", "[domains]") {
    CHECK_THAT(camera_notes(number("fov", "1e-6")), Contains("radians"));
    CHECK_THAT(camera_notes("<string name='focal_length' value='1e9mm'/>"), Contains("radians"));
    CHECK(camera_notes(number("fov", "1")).find("radians") == std::string::npos);
    CHECK(camera_notes("").find("radians") == std::string::npos);
}

TEST_CASE("Domain notes: a lens that single precision does not hold is refused", "[domains]") {
    Camera camera;
    camera.fov_degrees = 40;
    camera.aperture_radius = 1, camera.focus_distance = 1;
    SceneFrame frame;
    CHECK_NOTHROW(camera_record(camera, 4, 4, frame));
    frame.scale = 0x1p120;
    CHECK_THROWS_AS(camera_record(camera, 4, 4, frame), InputError);
    frame.scale = 0x1p-120;
    CHECK_THROWS_AS(camera_record(camera, 4, 4, frame), InputError);
    camera.aperture_radius = 0; // a pinhole has no use for it
    CHECK_NOTHROW(camera_record(camera, 4, 4, frame));
}
