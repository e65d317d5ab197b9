// The lines of OBJ files: every word of its list, words of no list, comments, continued lines,
// numbers.
#include "test_mesh_tools.h"

#include "host/scene/meshes/data_text.h"
#include "host/scene/meshes/mesh_obj.h"
#include "host/scene/meshes/obj_keywords.h"

#include <glm/geometric.hpp>

#include <cstdlib>

using namespace parhelion;
using namespace parhelion::test;
using Catch::Matchers::Contains;

namespace {

const std::string square = "v -1 -1 0\nv 1 -1 0\nv 1 1 0\nv -1 1 0\nv -2 -2 0\n";

MeshData obj(const std::string& text) { return parse_obj(text, false, "a.obj"); }

double area(const MeshData& mesh) {
    double sum = 0.0;
    for (const glm::uvec3& t : mesh.triangles) {
        const glm::dvec3& a = mesh.positions[t[0]];
        sum += glm::length(glm::cross(mesh.positions[t[1]] - a, mesh.positions[t[2]] - a)) / 2.0;
    }
    return sum;
}

} // namespace

TEST_CASE("scene obj lines: a byte order mark costs no line") {
    CHECK(area(obj(square + "f 1 2 3 4\n")) == 4.0);
    const std::string mark = "\xef\xbb\xbf";
    CHECK(area(obj(mark + square + "f 1 2 3 4\n")) == 4.0);
    CHECK(area(obj(mark + square + mark + "f 1 2 3 4\n" + mark + "f 1 2 3\n")) == 6.0);
}

TEST_CASE("scene obj lines: every word of the list") {
    for (const ObjKeyword& keyword : obj_keywords) {
        const std::string word(keyword.word);
        INFO(word);
        const std::string text = square + word + " 1 2 3\nf 1 2 3 4\n";
        std::string upper = word;
        for (char& c : upper)
            c = static_cast<char>(std::toupper(c));
        const std::string text_upper = square + upper + " 1 2 3\nf 1 2 3 4\n";
        const bool read = keyword.kind <= ObjLine::face;
        if (keyword.kind == ObjLine::shape) {
            CHECK_THAT(refusal([&] { obj(text); }),
                       Contains("a.obj:6") && Contains("\"" + word + "\"") && Contains("not read"));
        } else {
            CHECK(obj(text).notes.size() == (keyword.kind == ObjLine::line_or_point ? 1 : 0));
            CHECK(area(obj(text)) == (keyword.kind == ObjLine::face ? 6.0 : 4.0));
        }
        if (read)
            CHECK_THAT(refusal([&] { obj(text_upper); }),
                       Contains("a.obj:6") && Contains("\"" + upper + "\"") &&
                           Contains("accepted: \"" + word + "\""));
        else
            CHECK_THAT(obj(text_upper).notes.at(0), Contains("1 line begins") && Contains(upper));
    }
}

TEST_CASE("scene obj lines: words of no list are counted, colours said") {
    const MeshData mesh = obj(square + "foo\n  v, 1 1 1\n  bar 1\nf 1 2 3 4\n");
    REQUIRE(mesh.notes.size() == 1);
    CHECK_THAT(mesh.notes[0], Contains("a.obj: 3 lines") && Contains("\"foo\" in line 6"));
    CHECK(area(mesh) == 4.0);
    CHECK_THAT(obj("v 0 0 0 1 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n").notes.at(0), Contains("colours"));
    CHECK(obj("v 0 0 0 1\nv 1 0 0 1\nv 0 1 0 1\nf 1 2 3\n").notes.empty()); // weights
}

TEST_CASE("scene obj lines: lines go on after a backslash, comments do not") {
    CHECK(area(obj(square + "f 1 2 \\\n3 \\\r\n 4\n")) == 4.0);
    CHECK(area(obj("v -1 \\\n-1 0\n" + square.substr(10) + "f 1 2 3 4\n")) == 4.0);
    CHECK(area(obj(square + "# c:\\folder\\\nf 1 2 3 4\n")) == 4.0);
    CHECK(area(obj(square + "mtllib c:\\folder\\\nf 1 2 3 4\n")) == 4.0);
    CHECK(area(obj(square + "f 1 2 3 4 # no more\\\nf 1 2 3\n")) == 6.0);
    CHECK_THAT(refusal([] { obj(square + "f 1 \\\n2 \\\n3\nf 1 2 9\n"); }), Contains("a.obj:9:"));
    CHECK(area(obj(square + "f 1 2 3 4 \\")) == 4.0);
}

TEST_CASE("scene obj lines: corners, with parts left out or named in vain") {
    const std::pair<const char*, bool> faces[] = {
        {"1 2 3 4", false},
        {"1/ 2/ 3/ 4/", false},
        {"1// 2// 3// 4//", false},
        {"1//1 2//2 3//3 4//4", true},
        {"1/1 2/2 3/3 4/4", true},
        {"1/1/ 2/1/ 3/1/ 4/1/", true},
        {"1/5/6 2/5/6 3/5/6 4/5/6", true},
        {"-5/-1/-1 -4/-1/-1 -3/-1/-1 -2/-1/-1", true},
    };
    for (const auto& [face, in_vain] : faces) {
        INFO(face);
        const MeshData mesh = obj(square + "f " + face + "\n");
        CHECK(area(mesh) == 4.0);
        CHECK(mesh.positions.size() == 4);
        CHECK(mesh.normals.empty());
        CHECK(mesh.uvs.empty());
        CHECK(mesh.notes.size() == (in_vain ? 1 : 0));
    }
}

TEST_CASE("scene obj lines: numbers are read to the nearest double, whatever their size") {
    for (const char* const text : {"0",
                                   "-0",
                                   "1",
                                   "+2.5",
                                   ".5",
                                   "5.",
                                   "1e-250",
                                   "-4.9406564584124654e-324",
                                   "1e-400",
                                   "-1e-99999999999999999999999",
                                   "0.1",
                                   "123456789.123456789",
                                   "1e308",
                                   "1e309",
                                   "-1e400",
                                   "1e99999999999999999999999",
                                   "0e99999999999999999999999",
                                   "1e+05",
                                   "2.2250738585072011e-308",
                                   "inf",
                                   "-inf",
                                   "Infinity"}) {
        INFO(text);
        const auto value = parse_real(text);
        REQUIRE(value);
        CHECK(*value == std::strtod(text, nullptr));
        CHECK(std::signbit(*value) == std::signbit(std::strtod(text, nullptr)));
    }
    CHECK(parse_real("0." + std::string(400, '0') + "1") == 0.0);
    CHECK(parse_real("1" + std::string(400, '0')) == std::numeric_limits<double>::infinity());
    CHECK(parse_real("0." + std::string(400, '0') + "1e401") == 1.0);
    for (const char* const text : {"nan", "-nan", "NaN", "nan(ind)", "1.#QNAN", "-1.#IND000"}) {
        INFO(text);
        CHECK(std::isnan(parse_real(text).value_or(0.0)));
    }
    for (const char* const text : {"", "x", "1x", "1,5", "--1", "+-1", "1e", "0x10", "1 2"}) {
        INFO(text);
        CHECK_FALSE(parse_real(text));
    }
    CHECK(area(obj("v 0 0 1e-250\nv 1 0 -1e-400\nv 0 1 0\nv 1.#QNAN 0 1e999\nf 1 2 3\n")) == 0.5);
}
