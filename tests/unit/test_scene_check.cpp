// The doctor of scenes: what of a file is exact, approximated, refused.
#include "host/commands/scene_check.h"
#include "tests/support/image_files.h"
#include "tests/unit/test_scene_tools.h"

#include <catch2/catch.hpp>

using namespace parhelion;
using Catch::Matchers::Contains;

namespace {

constexpr const char* start =
    "<scene version='3.0.0'>\n<integrator type='path'/>\n<sensor type='perspective'>\n"
    "<film type='hdrfilm'><rfilter type='box'/></film>\n";

nlohmann::json check_of(const std::string& rest, bool lenient = false) {
    const test::SceneFolder folder;
    const std::string file = folder.write("scene.xml", start + rest);
    LoadOptions options;
    options.lenient = lenient;
    nlohmann::json check = check_scene(file, options);
    CHECK(check["scene"] == file);
    return check;
}

nlohmann::json counts_of(const nlohmann::json& check, const std::string& plugin) {
    for (const nlohmann::json& row : check["constructs"])
        if (row["plugin"] == plugin) return {row["exact"], row["approximated"], row["refused"]};
    return {};
}

const std::string ball = "<shape type='sphere'>\n<bsdf type='diffuse'/></shape>\n";

} // namespace

TEST_CASE("Scene check: what is as written is exact") {
    nlohmann::json check =
        check_of("<sampler type='independent'/></sensor>\n" + ball + ball + "</scene>");
    CHECK(check["verdict"] == "exact");
    CHECK(check["messages"].empty());
    CHECK(counts_of(check, "sphere") == nlohmann::json{2, 0, 0});
    CHECK(check_exit_code(check) == ExitCode::ok);
    CHECK_THAT(check_text(check), Contains("scene.xml: exact\n") && Contains("shape sphere (2)"));
}

TEST_CASE("Scene check: a note makes its construct an approximated one") {
    nlohmann::json check = check_of("<sampler type='halton'/></sensor>\n" + ball + "</scene>");
    CHECK(check["verdict"] == "approximated");
    REQUIRE(check["messages"].size() == 1);
    CHECK(check["messages"][0]["construct"] == "sampler halton");
    CHECK(counts_of(check, "halton") == nlohmann::json{0, 1, 0});
    CHECK(counts_of(check, "diffuse") == nlohmann::json{1, 0, 0});
    CHECK(check_exit_code(check) == ExitCode::different);
}

TEST_CASE("Scene check: of what is refused it is told what --lenient makes") {
    const std::string rest = "<sampler type='halton'/></sensor>\n" + ball +
                             "<shape type='sphere'><bsdf type='hair'/></shape>\n"
                             "<shape type='blob'/></scene>";
    nlohmann::json check = check_of(rest);
    CHECK(check["verdict"] == "refused");
    CHECK(check["opens_leniently"] == true);
    CHECK(counts_of(check, "hair") == nlohmann::json{0, 0, 1});
    CHECK(counts_of(check, "blob") == nlohmann::json{0, 0, 1});
    CHECK(counts_of(check, "halton") == nlohmann::json{0, 1, 0});
    CHECK(counts_of(check, "sphere") == nlohmann::json{2, 0, 0});
    CHECK(check_exit_code(check) == ExitCode::bad_input);
    CHECK_THAT(check_text(check), Contains("opens with --lenient\n") &&
                                      Contains("scene.xml:8: bsdf plugin \"hair\"") &&
                                      Contains("  leniently: ") && Contains("left out"));
    for (const nlohmann::json& message : check["messages"])
        CHECK(message.contains("leniently") == (message["status"] == "refused"));

    nlohmann::json lenient = check_of(rest, true);
    CHECK(lenient["verdict"] == "approximated");
    CHECK(counts_of(lenient, "hair") == nlohmann::json{0, 1, 0});
    CHECK_FALSE(lenient.contains("opens_leniently"));
}

TEST_CASE("Scene check: what is broken stays refused, and so is a file that is no scene") {
    nlohmann::json check = check_of("<sampler type='independent'/></sensor>\n<shape type='sphere'>"
                                    "<float name='radius' value='-1'/></shape></scene>");
    CHECK(check["opens_leniently"] == false);
    CHECK_THAT(check_text(check), Contains("not even --lenient opens it") && Contains("radius"));
    for (const nlohmann::json& none : {check_of("<shape"), check_scene("none.xml", {})}) {
        CHECK(check_exit_code(none) == ExitCode::bad_input);
        CHECK(none["opens_leniently"] == false);
        CHECK(none["messages"].size() == 1);
        CHECK_THAT(check_text(none), Contains("refused: ") && Contains("xml"));
    }
}

TEST_CASE("Scene check: values of images and shapes too small to be seen are found as well") {
    const test::SceneFolder folder;
    folder.write("wild.pfm", test::pfm_of(1, 3, std::vector<float>(9, 1.5F), 3));
    const std::string matte = "<bsdf type='diffuse'>\n<texture type='bitmap' name='reflectance'>"
                              "<string name='filename' value='wild.pfm'/></texture></bsdf>";
    const nlohmann::json wild =
        check_scene(folder.write("wild.xml", start + ("</sensor><shape type='sphere'>" + matte +
                                                      "</shape></scene>")),
                    {});
    CHECK(wild["verdict"] == "refused");
    CHECK_THAT(check_text(wild), Contains("wild.xml:") && Contains("1.5") && Contains("0 to 1"));

    const nlohmann::json grain =
        check_of("</sensor>" + ball +
                 "<shape type='sphere'><float name='radius' value='1e-7'/>"
                 "<point name='center' x='1e6' y='0' z='0'/></shape></scene>");
    CHECK(grain["verdict"] == "approximated");
    CHECK_THAT(check_text(grain), Contains("single precision"));
}

TEST_CASE("Scene check: several constructs in one line are told apart by what is said") {
    const nlohmann::json check = check_of("</sensor>" + ball +
                                          "<shape type='sphere'/><emitter type='constant'/>"
                                          "<emitter type='constant'/></scene>");
    CHECK(check["verdict"] == "refused");
    CHECK(check["messages"][0]["construct"] == "emitter constant");
    CHECK(counts_of(check, "sphere") == nlohmann::json{2, 0, 0});
}

TEST_CASE("Scene check: a fault inside a mesh's file is its shape's") {
    const test::SceneFolder folder;
    folder.write("nan.obj", "v nan 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    const nlohmann::json check = check_scene(
        folder.write("scene.xml", start + std::string("</sensor>\n<shape type='obj'><string "
                                                      "name='filename' value='nan.obj'/></shape>"
                                                      "</scene>")),
        {});
    CHECK(counts_of(check, "obj") == nlohmann::json{0, 0, 1});
    CHECK_THAT(check_text(check), Contains("scene.xml:6: ") && Contains("nan.obj:4: "));
}

TEST_CASE("Scene check: leniently, what another sensor has is told and not called exact") {
    const nlohmann::json check =
        check_of("</sensor><sensor type='hemi'/>\n" + ball + "</scene>", true);
    CHECK(check["verdict"] == "approximated");
    CHECK(counts_of(check, "hemi") == nlohmann::json{0, 1, 0});
}
