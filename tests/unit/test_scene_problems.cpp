// All that is wrong with a file is said at once: a line for each, in the file's own words.
#include "host/problems.h"
#include "test_scene_tools.h"

#include <sstream>
#include <vector>

using namespace parhelion;
using namespace parhelion::test;
using Catch::Matchers::Contains;

namespace {

std::vector<std::string> lines_of(const std::string& text) {
    std::vector<std::string> lines;
    std::istringstream in(text);
    for (std::string line; std::getline(in, line);)
        lines.push_back(line);
    return lines;
}

/// Every line of the message holds the part at its place, and there are no others.
void check_lines(const std::string& message, const std::vector<std::string>& parts) {
    INFO(message);
    const std::vector<std::string> lines = lines_of(message);
    REQUIRE(lines.size() == parts.size());
    for (std::size_t i = 0; i < parts.size(); i++)
        CHECK_THAT(lines[i], Contains(parts[i]));
}

} // namespace

TEST_CASE("scene problems: those of all plugins, each with its line") {
    check_lines(refusal_of_body("<shape type=\"torus\"/>\n"
                                "<shape type=\"sphere\"><bsdf type=\"velvet\"/></shape>\n"
                                "<emitter type=\"laser\"/>\n"
                                "<bsdf type=\"diffuse\" id=\"a\">\n"
                                "<float name=\"glow\" value=\"1\"/>\n"
                                "<float name=\"sheen\" value=\"1\"/>\n"
                                "<rgb name=\"reflectance\" value=\"2\"/></bsdf>"),
                {"scene.xml:2: shape plugin \"torus\" is not supported (accepted: obj",
                 "scene.xml:3: bsdf plugin \"velvet\" is not supported (accepted: diffuse",
                 "scene.xml:4: emitter plugin \"laser\" is not supported (accepted: point",
                 "scene.xml:8: bsdf plugin \"diffuse\": parameter \"reflectance\" is 2",
                 "scene.xml:6: bsdf plugin \"diffuse\" has no parameter \"glow\" (accepted: "
                 "reflectance)",
                 "scene.xml:7: bsdf plugin \"diffuse\" has no parameter \"sheen\""});
}

TEST_CASE("scene problems: a shape, its light and its bsdf are looked at each") {
    check_lines(refusal_of_body("<shape type=\"ply\"><string name=\"filename\" value=\"no.ply\"/>\n"
                                "<emitter type=\"area\"><rgb name=\"radiance\" value=\"-1\"/>"
                                "</emitter>\n"
                                "<bsdf type=\"cloth\"/></shape>"),
                {"scene.xml:2: file \"no.ply\" not found", "scene.xml:3: emitter plugin \"area\"",
                 "scene.xml:4: bsdf plugin \"cloth\""});
    check_lines(refusal_of_text("<scene version=\"3.0.0\"><sensor type=\"perspective\">\n"
                                "<float name=\"fov\" value=\"200\"/>\n"
                                "<film type=\"x\"/>\n<sampler type=\"y\"/></sensor></scene>"),
                {"scene.xml:2: sensor", "scene.xml:3: film", "scene.xml:4: sampler"});
}

TEST_CASE("scene problems: what cannot be read does not hide what can, nor cause other lines") {
    check_lines(refusal_of_body("<shape type=\"sphere\">\n<float name=\"radius\" value=\"x\"/>\n"
                                "<mode name=\"a\"/>\n<point name=\"center\" x=\"1\"/>\n"
                                "<ref id=\"nobody\"/></shape>\n"
                                "<shape type=\"obj\"><integer name=\"filename\" value=\"1\"/>"
                                "</shape>"),
                {"scene.xml:3: <float>: \"x\"",
                 "scene.xml:4: unknown element <mode> (accepted: float", "scene.xml:5: <point>",
                 "scene.xml:6: <ref>: there is no object",
                 "scene.xml:7: shape plugin \"obj\": parameter \"filename\" is given as"});
}

TEST_CASE("scene problems: names are spelled as in the file") {
    CHECK_THAT(refusal_of_text("<scene version=\"0.6.0\">\n<sensor type=\"perspective\">"
                               "<float name=\"nearClip\" value=\"-1\"/>\n"
                               "<float name=\"strictNormals\" value=\"1\"/></sensor></scene>"),
               Contains("scene.xml:2") && Contains("\"nearClip\" is -1") &&
                   Contains("scene.xml:3") && Contains("\"strictNormals\"") &&
                   Contains("fov_axis"));
}

TEST_CASE("scene problems: the same is said once, and a hundred lines are enough") {
    std::string body = "<bsdf type=\"velvet\" id=\"a\"/>\n";
    for (int i = 0; i < 3; i++)
        body += "<shape type=\"sphere\"><ref id=\"a\"/></shape>\n";
    CHECK(lines_of(refusal_of_body(body)).size() == 1);
    for (int i = 0; i < 150; i++)
        body += "<emitter type=\"e" + std::to_string(i) + "\"/>\n";
    const std::vector<std::string> lines = lines_of(refusal_of_body(body));
    REQUIRE(lines.size() == 101);
    CHECK(lines.back() == "and 51 more");
}

TEST_CASE("problems: what is thrown is kept, and thrown again in its order") {
    Problems problems;
    CHECK(problems.attempt([] {}));
    problems.throw_if_any();
    CHECK_FALSE(problems.attempt([] { throw InputError("b"); }));
    CHECK_FALSE(problems.attempt([] { throw InputError("a\nx"); }));
    problems.add(InputError(std::vector<std::string>{"b", "c"}));
    try {
        problems.throw_if_any();
        FAIL("nothing thrown");
    } catch (const InputError& error) {
        CHECK(std::string(error.what()) == "b\na\\nx\nc");
    }
}
