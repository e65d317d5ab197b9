// What stands around the root of a scene file, its version, and what of a file reaches the notes.
#include "test_scene_tools.h"

using namespace parhelion;
using namespace parhelion::test;
using Catch::Matchers::Contains;

TEST_CASE("scene xml: nothing may stand beside the root") {
    const std::string scene = scene_text("");
    CHECK(refusal_of_text(scene).empty());
    CHECK(refusal_of_text("<!-- before -->\n" + scene + "<!-- after -->\n \n").empty());
    CHECK(refusal_of_text("\xef\xbb\xbf<?xml version=\"1.0\"?>" + scene).empty());
    CHECK_THAT(refusal_of_text(scene + scene), Contains("scene.xml:5") && Contains("second root"));
    CHECK_THAT(refusal_of_text(scene + "<bsdf/>"), Contains("<bsdf>"));
    CHECK_THAT(refusal_of_text(scene + "\ngarbage"),
               Contains("scene.xml:6") && Contains("garbage"));
    CHECK_THAT(refusal_of_text("garbage" + scene), Contains("garbage"));
    CHECK_THAT(refusal_of_text(scene + "<![CDATA[garbage]]>"), Contains("garbage"));
    const SceneFolder folder;
    folder.write("part.xml", "<scene version=\"3.0.0\"/><scene version=\"3.0.0\"/>");
    CHECK_THAT(
        refusal_of(folder.write("scene.xml", scene_text("<include filename=\"part.xml\"/>"))),
        Contains("part.xml:1") && Contains("second root"));
}

TEST_CASE("scene xml: a version newer than the reader's is said") {
    CHECK(load_body("", "3.99.0").notes.empty());
    for (const char* const version : {"4.0.0", "99.0.0"})
        CHECK_THAT(load_body("", version).notes.at(0),
                   Contains(":1: version \"" + std::string(version) + "\"") && Contains("newer"));
}

TEST_CASE("scene xml: control characters of names do not reach the notes") {
    const SceneFolder folder;
    folder.write("\x1b[31m.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nl 1 2\nf 1 2 3\n");
    const Scene scene = load_scene(folder.write(
        "scene.xml",
        scene_text("<shape type=\"obj\" id=\"&#27;]0;x&#7;\"><string name=\"filename\" "
                   "value=\"&#27;[31m.obj\"/></shape>")));
    REQUIRE_FALSE(scene.notes.empty());
    for (const std::string& note : scene.notes) {
        CHECK_THAT(note, Contains("[31m.obj"));
        CHECK(std::none_of(note.begin(), note.end(), [](char c) { return c >= 0 && c < ' '; }));
    }
}
