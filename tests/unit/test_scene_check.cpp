// The doctor of scenes: what of a file is exact, approximated, refused.
#include "host/commands/scene_check.h"
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

TEST_CASE("Scene check: what is broken stays refused, and a file that is no scene throws") {
    nlohmann::json check = check_of("<sampler type='independent'/></sensor>\n<shape type='sphere'>"
                                    "<float name='radius' value='-1'/></shape></scene>");
    CHECK(check["opens_leniently"] == false);
    CHECK_THAT(check_text(check), Contains("not even --lenient opens it") && Contains("radius"));
    CHECK_THROWS_AS(check_of("<shape"), InputError);
    CHECK_THROWS_AS(check_scene("none.xml", {}), InputError);
}
