// Names of outputs made of what a render is: the values there are, padding as other programs have
// it.
#include "host/commands/name_pattern.h"
#include "host/error.h"

#include <catch2/catch.hpp>

#include <array>
#include <cstdio>

using namespace parhelion;
using Catch::Matchers::Contains;

namespace {

std::string named(const std::string& pattern, const NameValues& values) {
    return expanded_name("--output", pattern, values);
}

NameValues at_frame(std::int64_t frame) { return {{{"frame", std::to_string(frame)}}, frame}; }

} // namespace

TEST_CASE("Names: $name is the longest that there is, a backslash takes it for itself") {
    const NameValues values{{{"a", "1"}, {"angle", "0.5"}, {"scene", "hall"}, {"none", ""}}, {}};
    CHECK(named("x.exr", values) == "x.exr");
    CHECK(named("", values).empty());
    CHECK(named("$scene-$angle.exr", values) == "hall-0.5.exr");
    CHECK(named("$angle_$a$a.exr", values) == "0.5_11.exr");
    CHECK(named("$angles", values) == "0.5s");
    CHECK(named("$ax", values) == "1x");
    CHECK(named("[$none]", values) == "[]");
    CHECK(named("\\$a-$a", values) == "$a-1");
    CHECK(named("a\\b\\", values) == "a\\b\\");
    // Values are not looked into.
    CHECK(named("$a", {{{"a", "$a####"}}, {}}) == "$a####");
    // Without a frame these are characters like others.
    CHECK(named("##-%04d-\\#.exr", values) == "##-%04d-\\#.exr");
    for (const std::string pattern : {"$", "$x.exr", "a-$.exr", "$Angle", "$frame"})
        CHECK_THROWS_WITH(named(pattern, values),
                          Contains("--output") && Contains("$a, $angle, $scene, $none"));
    CHECK_THROWS_WITH(named("$wrong_1-x.exr", values), Contains("no value for \"$wrong_1\""));
}

TEST_CASE("Names: frames padded as printf and as Blender do") {
    for (const std::int64_t frame : {0, 1, 42, 999, 1000, 123456, -1, -42, -1000}) {
        std::array<char, 64> text{};
        INFO(frame);
        for (int width = 1; width <= 9; width++) {
            const std::string c = "%0" + std::to_string(width) + "d";
            std::snprintf(text.data(), text.size(), "%0*d", width, static_cast<int>(frame));
            CHECK(named(c, at_frame(frame)) == text.data());
            // BLI_path_frame of Blender: "%.*d".
            std::snprintf(text.data(), text.size(), "%.*d", width, static_cast<int>(frame));
            CHECK(named(std::string(static_cast<std::size_t>(width), '#'), at_frame(frame)) ==
                  text.data());
        }
        CHECK(named("%d", at_frame(frame)) == std::to_string(frame));
        CHECK(named("$frame", at_frame(frame)) == std::to_string(frame));
    }
    CHECK(named("a-####-#.exr", at_frame(7)) == "a-0007-7.exr");
    CHECK(named("a-%04d.%d.exr", at_frame(7)) == "a-0007.7.exr");
    CHECK(named("\\####-\\%d-\\$frame", at_frame(7)) == "#007-%d-$frame");
    for (const std::string plain : {"100%", "%s", "%4d", "%00d", "%04", "%0", "%%"})
        CHECK(named(plain, at_frame(7)) == plain);
}
