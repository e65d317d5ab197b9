// The syntax of a scene file: parameters, includes, references, versions, and what is no scene.
#include "test_scene_tools.h"

using namespace parhelion;
using namespace parhelion::test;
using Catch::Matchers::Contains;
using Catch::Matchers::Equals;

namespace {

double radius_of(const Scene& scene) {
    REQUIRE(scene.shapes.size() == 1);
    return std::get<Sphere>(scene.shapes[0].geometry).radius;
}

constexpr const char* sphere_of_r =
    "<shape type=\"sphere\"><float name=\"radius\" value=\"$r\"/></shape>";

} // namespace

TEST_CASE("scene xml: defaults, replaced by the command line") {
    const std::string body = std::string("<default name=\"r\" value=\"2.5\"/>") + sphere_of_r;
    CHECK(radius_of(load_body(body)) == 2.5);
    const SceneFolder folder;
    const std::string file = folder.write("scene.xml", scene_text(body));
    LoadOptions options;
    options.parameters["r"] = "4";
    CHECK(radius_of(load_scene(file, options)) == 4.0);
    options.parameters["rr"] = "4";
    CHECK_THAT(refusal_of(file, options), Contains("-D rr=4") && Contains("uses no $rr"));
}

TEST_CASE("scene xml: the first default stands and the longest name wins") {
    CHECK(radius_of(load_body("<default name=\"r\" value=\"1\"/><default name=\"r\" value=\"2\"/>"
                              "<default name=\"radius\" value=\"3\"/>"
                              "<shape type=\"sphere\"><float name=\"radius\" value=\"$radius.5\"/>"
                              "</shape>")) == 3.5);
}

TEST_CASE("scene xml: a value is substituted once, and an escaped dollar stays") {
    const Scene scene = load_body("<default name=\"a\" value=\"\\$b\"/>"
                                  "<shape type=\"sphere\" id=\"$a x \\$a\"/>");
    CHECK(scene.shapes[0].id == "$b x $a");
}

TEST_CASE("scene xml: substitution reaches the steps of a transform") {
    const Scene scene = load_body("<default name=\"k\" value=\"3\"/><shape type=\"sphere\">"
                                  "<transform name=\"to_world\"><scale value=\"$k\"/></transform>"
                                  "</shape>");
    CHECK(radius_of(scene) == 3.0);
}

TEST_CASE("scene xml: includes of scenes and of single objects") {
    const SceneFolder folder;
    folder.write("parts/all.xml", "<scene version=\"3.0.0\"><include filename=\"deep.xml\"/>"
                                  "<shape type=\"sphere\"><ref id=\"red\"/></shape></scene>");
    folder.write("parts/deep.xml", "<bsdf type=\"diffuse\" id=\"red\" version=\"3.0.0\">"
                                   "<rgb name=\"reflectance\" value=\"1 0 0\"/></bsdf>");
    const Scene scene =
        load_scene(folder.write("scene.xml", scene_text("<include filename=\"parts/all.xml\"/>")));
    REQUIRE(scene.shapes.size() == 1);
    CHECK(scene.materials.at(scene.shapes[0].material_front).id == "red");
    CHECK_THAT(scene.materials[0].location.to_string(), Contains("parts/deep.xml:1"));
}

TEST_CASE("scene xml: an include that includes itself is refused") {
    const SceneFolder folder;
    const std::string file =
        folder.write("scene.xml", scene_text("<include filename=\"scene.xml\"/>"));
    CHECK_THAT(refusal_of(file), Contains("scene.xml:2") && Contains("15 deep"));
}

TEST_CASE("scene xml: references by id, alias and before the definition") {
    const Scene scene = load_body("<shape type=\"sphere\"><ref id=\"late\"/></shape>"
                                  "<bsdf type=\"null\" id=\"late\"/>"
                                  "<alias id=\"late\" as=\"other\"/>"
                                  "<shape type=\"disk\"><ref id=\"other\"/></shape>");
    REQUIRE(scene.materials.size() == 1);
    CHECK(scene.shapes[0].material_front == scene.shapes[1].material_front);
}

TEST_CASE("scene xml: files older than version 2.0 name parameters in camel case") {
    const SceneFolder folder;
    const std::string old = "<scene version=\"0.6.0\"><sensor type=\"perspective\">"
                            "<string name=\"fovAxis\" value=\"smaller\"/>"
                            "<float name=\"fov\" value=\"30\"/>"
                            "<transform name=\"toWorld\"><lookAt origin=\"0 0 1\" target=\"0 0 0\" "
                            "up=\"0 1 0\"/></transform></sensor>"
                            "<integrator type=\"path\"><integer name=\"maxDepth\" value=\"7\"/>"
                            "</integrator><bsdf type=\"diffuse\" id=\"a\">"
                            "<rgb name=\"diffuseReflectance\" value=\".25\"/></bsdf>"
                            "<shape type=\"sphere\"><ref id=\"a\"/></shape></scene>";
    const Scene scene = load_scene(folder.write("scene.xml", old));
    CHECK(scene.camera.fov_axis == FovAxis::smaller);
    CHECK(scene.camera.to_world[3] == glm::dvec4(0, 0, 1, 1));
    CHECK(scene.integrator.max_depth == 7);
    CHECK(std::get<DiffuseBsdf>(scene.materials[0].bsdf).reflectance == Rgb(0.25));
    // What plugins hold as well.
    const Scene held = load_scene(folder.write(
        "held.xml", "<scene version=\"0.5.0\"><texture type=\"checkerboard\" id=\"t\"/>"
                    "<shape type=\"sphere\"><bsdf type=\"diffuse\">"
                    "<ref name=\"diffuseReflectance\" id=\"t\"/></bsdf></shape>"
                    "<shape type=\"sphere\"><bsdf type=\"plastic\"><texture "
                    "name=\"diffuseReflectance\" type=\"checkerboard\"/></bsdf></shape>"
                    "</scene>"));
    CHECK(std::get<DiffuseBsdf>(held.materials[0].bsdf).reflectance.texture);
    CHECK(std::get<PlasticBsdf>(held.materials[1].bsdf).diffuse_reflectance.texture);
    // A new file has no such names.
    CHECK_THAT(refusal_of_body("<shape type=\"sphere\"><float name=\"myRadius\" value=\"1\"/>"
                               "</shape>"),
               Contains("scene.xml:2") && Contains("\"myRadius\"") && Contains("radius"));
}

TEST_CASE("scene xml: folders of <path> are searched") {
    const SceneFolder folder;
    folder.write("meshes/one.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    const Scene scene = load_scene(folder.write(
        "scene.xml", scene_text("<path value=\"meshes\"/><shape type=\"obj\">"
                                "<string name=\"filename\" value=\"one.obj\"/></shape>")));
    CHECK(std::get<Mesh>(scene.shapes[0].geometry).triangles.size() == 1);
}

TEST_CASE("scene xml: files outside the scene's folder need leave") {
    const SceneFolder folder;
    const std::string mesh = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
    const std::string outside = folder.write("one.obj", mesh);
    folder.write("inner/a.obj", mesh);
    std::filesystem::create_symlink(outside, folder.path() / "inner" / "link.obj");
    const auto body = [](const std::string& name) {
        return scene_text("<shape type=\"obj\">\n<string name=\"filename\" value=\"" + name +
                          "\"/></shape>");
    };
    for (const std::string& name : {std::string("../one.obj"), outside, std::string("link.obj"),
                                    std::string("../inner/../one.obj")}) {
        const std::string file = folder.write("inner/scene.xml", body(name));
        CHECK_THAT(refusal_of(file), Contains("scene.xml:3") && Contains("--allow-outside"));
        LoadOptions options;
        options.allow_outside = true;
        CHECK(load_scene(file, options).shapes.size() == 1);
    }
    CHECK(refusal_of(folder.write("inner/scene.xml", body("../inner/a.obj"))).empty());
    CHECK_THAT(refusal_of(folder.write("inner/scene.xml", scene_text("<path value=\"..\"/>"))),
               Contains("scene.xml:2") && Contains("--allow-outside"));
    CHECK_THAT(refusal_of(folder.write("inner/scene.xml", body("no.obj"))),
               Contains("scene.xml:3") && Contains("\"no.obj\" not found (looked in: \"") &&
                   Contains("inner\")"));
    std::filesystem::create_directory(folder.path() / "inner" / "meshes");
    CHECK_THAT(refusal_of(folder.write("inner/scene.xml", body("meshes"))),
               Contains("scene.xml:3") && Contains("\"meshes\" not found: it is a folder (looked"));
    CHECK_THAT(refusal_of(folder.write("inner/scene.xml", body("/dev/null"))),
               Contains("\"/dev/null\" not found: it is neither a file nor a folder"));
    CHECK_THAT(refusal_of(folder.write("inner/scene.xml", scene_text("<path value=\"a.obj\"/>"))),
               Contains("folder \"a.obj\" not found: it is a file"));
}

TEST_CASE("scene xml: document types and entities are refused") {
    CHECK_THAT(refusal_of_text("<?xml version=\"1.0\"?>\n<!DOCTYPE scene [<!ENTITY a \"b\">]>\n"
                               "<scene version=\"3.0.0\"/>"),
               Contains("scene.xml:2") && Contains("DOCTYPE"));
    CHECK_THAT(refusal_of_body("<shape type=\"sphere\" id=\"&a;\"/>"),
               Contains("scene.xml:2") && Contains("&a"));
    CHECK(load_body("<shape type=\"sphere\" id=\"&lt;&#65;&amp;b\"/><!-- &a; -->").shapes[0].id ==
          "<A&b");
}

TEST_CASE("scene xml: what is no scene is refused with file and line") {
    struct Case {
        std::string text, part;
    };
    std::string nested;
    for (int i = 0; i < 70; ++i)
        nested += "<bsdf type=\"twosided\">";
    for (int i = 0; i < 70; ++i)
        nested += "</bsdf>";
    const Case cases[] = {
        {"", "XML"},
        {"<scene version=\"3.0.0\">\n<shape type=\"sphere\"></scene>", "scene.xml:2"},
        {"<scene/>", "lacks the attribute \"version\""},
        {"<scene version=\"a.b\"/>", "\"a.b\""},
        {"<scene version=\"1.2.3.4\"/>", "\"1.2.3.4\""},
        {"<mesh version=\"3.0.0\"/>", "<mesh>"},
        {scene_text("<foo/>"), "scene.xml:2: unknown element <foo>"},
        {scene_text("<scale value=\"2\"/>"), "scene.xml:2: unknown element <scale>"},
        {scene_text("hello"), "scene.xml:2: stray text \"hello\""},
        {scene_text("<shape/>"), "scene.xml:2: <shape> lacks the attribute \"type\""},
        {scene_text("<shape type=\"sphere\" foo=\"1\"/>"), "\"foo\""},
        {scene_text("<shape type=\"sphere\"/>\n<shape type=\"torus\"/>"),
         "scene.xml:3: shape plugin \"torus\" is not supported (accepted: obj, ply"},
        {scene_text("<float name=\"a\" value=\"1\"/>"), "scene.xml:2"},
        {scene_text("<shape type=\"sphere\" id=\"a\"/>\n<bsdf type=\"null\" id=\"a\"/>"),
         "scene.xml:3: id \"a\" is already taken at scene.xml:2"},
        {scene_text("<shape type=\"sphere\"><ref id=\"a\"/></shape>"), "id \"a\""},
        {scene_text("<alias id=\"a\" as=\"b\"/>"), "id \"a\""},
        {scene_text("<shape type=\"sphere\"><path value=\".\"/></shape>"), "<path>"},
        {scene_text("<include filename=\"none.xml\"/>"), "\"none.xml\" not found"},
        {scene_text("<default name=\"\" value=\"1\"/>"), "the name is empty"},
        {scene_text("<shape type=\"$a\"/>"), "\"$a\" has no value"},
        {scene_text("<bsdf type=\"twosided\" id=\"a\"><ref id=\"b\"/></bsdf>\n"
                    "<bsdf type=\"twosided\" id=\"b\"><ref id=\"a\"/></bsdf>"),
         "contain itself"},
        {scene_text(nested), "64 deep"},
        {scene_text("<texture type=\"bitmap\" id=\"a\"/>"), "texture plugin \"bitmap\""},
        {scene_text("<integrator type=\"path\"/>"), "a second <integrator>"},
        {scene_text("<emitter type=\"constant\"/>\n<emitter type=\"constant\"/>"), "scene.xml:3"},
        {std::string("<scene version=\"3.0.0\">\n\0</scene>", 33), "scene.xml:2"},
    };
    for (const Case& c : cases) {
        const std::string message = refusal_of_text(c.text);
        INFO(c.text.substr(0, 200));
        CHECK_THAT(message, Contains("scene.xml") && Contains(c.part));
        CHECK(message.find('\n') == std::string::npos);
    }
}

TEST_CASE("scene xml: values that cannot be read are refused with their line") {
    struct Case {
        std::string parameter, part;
    };
    const Case cases[] = {
        {"<float name=\"radius\" value=\"foo\"/>", "\"foo\""},
        {"<float name=\"radius\" value=\"1x\"/>", "\"1x\""},
        {"<float name=\"radius\" value=\"1 2\"/>", "\"1 2\""},
        {"<float name=\"radius\" value=\"\"/>", "\"\""},
        {"<float name=\"radius\" value=\"nan\"/>", "\"nan\""},
        {"<float name=\"radius\" value=\"inf\"/>", "\"inf\""},
        {"<float name=\"radius\" value=\"1e999\"/>", "\"1e999\""},
        {"<float name=\"radius\" value=\"0x10\"/>", "\"0x10\""},
        {"<float name=\"radius\" value=\"1,5\"/>", "\"1,5\""},
        {"<integer name=\"radius\" value=\"99999999999999999999\"/>", "not an integer"},
        {"<integer name=\"radius\" value=\"1.5\"/>", "\"1.5\""},
        {"<boolean name=\"flip_normals\" value=\"yes\"/>", "\"yes\""},
        {"<point name=\"center\" x=\"1\" y=\"2\"/>", "\"z\""},
        {"<point name=\"center\" value=\"1 2\"/>", "three values"},
        {"<point name=\"center\" value=\"1 2 3\" x=\"1\"/>", "not both"},
        {"<string name=\"radius\" value=\"1\"/>", "parameter \"radius\" is given as <string>"},
        {"<float name=\"\" value=\"1\"/>", "the name is empty"},
        {"<float name=\"radius\" value=\"1\"><float/></float>", "cannot stand inside"},
        {"<float name=\"radius\" value=\"1\"/><float name=\"radius\" value=\"1\"/>", "given twice"},
        {"<rgb name=\"radius\" value=\"1 2\"/>", "one or three"},
        {"<rgb name=\"radius\" value=\"#12345\"/>", "#rrggbb"},
        {"<rgb name=\"radius\" value=\"#12345g\"/>", "#rrggbb"},
        {"<spectrum name=\"radius\" value=\"400:0.5\"/>", "at least two"},
        {"<spectrum name=\"radius\" value=\"400:0.5, foo\"/>", "\"foo\""},
        {"<spectrum name=\"radius\" value=\"500:0.5, 400:1\"/>", "must increase"},
        {"<spectrum name=\"radius\" value=\"400:a, 500:1\"/>", "\"a\""},
        {"<spectrum name=\"radius\"/>", "either value or filename"},
        {"<spectrum name=\"radius\" filename=\"none.spd\"/>", "not found"},
        {"<float name=\"radius\" value=\"0\"/>", "1e-100 to"},
        {"<float name=\"radius\" value=\"-1\"/>", "\"radius\" is -1"},
    };
    for (const Case& c : cases) {
        INFO(c.parameter);
        CHECK_THAT(refusal_of_body("<shape type=\"sphere\">\n" + c.parameter + "\n</shape>"),
                   Contains("scene.xml:3") && Contains(c.part));
    }
}

TEST_CASE("scene xml: numbers in the forms people write") {
    for (const char* const text : {"1.5", " 1.5 ", "+1.5", "15e-1", "1.50", "0.15E+1"})
        CHECK(radius_of(load_body("<shape type=\"sphere\"><float name=\"radius\" value=\"" +
                                  std::string(text) + "\"/></shape>")) == 1.5);
    CHECK(radius_of(load_body("<shape type=\"sphere\"><integer name=\"radius\" value=\"2\"/>"
                              "</shape>")) == 2.0);
}

TEST_CASE("scene xml: the file itself") {
    CHECK_THAT(refusal_of("/no/such/scene.xml"), Contains("no such file"));
    CHECK_THAT(refusal_of(std::filesystem::temp_directory_path().string()), Contains("not a file"));
    const SceneFolder folder;
    CHECK_THAT(refusal_of(folder.write("scene.txt", "")), Contains("accepted: .xml"));
}

TEST_CASE("scene xml: growth without end is refused") {
    std::string doubling = "<default name=\"a0\" value=\"0123456789\"/>\n";
    for (int i = 0; i < 60; ++i)
        doubling += "<default name=\"a" + std::to_string(i + 1) + "\" value=\"$a" +
                    std::to_string(i) + "-$a" + std::to_string(i) + "-\"/>\n";
    CHECK_THAT(refusal_of_body(doubling), Contains("scene.xml:") && Contains("grows beyond"));

    const SceneFolder folder;
    std::string many;
    for (int i = 0; i < 20; ++i)
        many += "<include filename=\"many.xml\"/>\n";
    folder.write("many.xml", "<scene version=\"3.0.0\">" + many + "</scene>");
    CHECK_THAT(refusal_of(folder.write("scene.xml", scene_text(many))), Contains("deep"));
    std::string wide;
    for (int i = 0; i < 1001; ++i)
        wide += "<include filename=\"empty.xml\"/>\n";
    folder.write("empty.xml", "<scene version=\"3.0.0\"/>");
    CHECK_THAT(refusal_of(folder.write("scene.xml", scene_text(wide))),
               Contains("scene.xml:1002") && Contains("1000 files"));

    std::string chain;
    for (int i = 0; i < 100; ++i)
        chain += "<integrator type=\"moment\" id=\"i" + std::to_string(i) + "\"><ref id=\"i" +
                 std::to_string(i + 1) + "\"/></integrator>\n";
    CHECK_THAT(refusal_of_body(chain + "<integrator type=\"path\" id=\"i100\"/>"),
               Contains("64 deep"));
}
