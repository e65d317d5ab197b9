// Texture plugins in scene files: what is read, what is folded into constants, what is refused.
#include "host/flatten/device_scene.h"
#include "host/flatten/energy_table.h"
#include "test_scene_tools.h"
#include "tests/support/image_files.h"

#include <fmt/format.h>

using namespace parhelion;
using namespace parhelion::test;
using Catch::Contains;

namespace {

/// A scene beside whose file stands `image.png`.
Scene load_with_image(const std::string& body, const std::string& version = "3.0.0") {
    SceneFolder folder;
    folder.write("image.png", png_of(six_colors()));
    return load_scene(folder.write("scene.xml", scene_text(body, version)));
}
std::string refusal_with_image(const std::string& body) {
    SceneFolder folder;
    folder.write("image.png", png_of(six_colors()));
    folder.write("broken.png", png_of(six_colors()).substr(0, 20));
    folder.write("text.png", "no image");
    return refusal_of(folder.write("scene.xml", scene_text(body)));
}

std::string diffuse(const std::string& inside) {
    return "<shape type='sphere'><bsdf type='diffuse'>" + inside + "</bsdf></shape>";
}
std::string bitmap(const std::string& more = "", const std::string& file = "image.png") {
    return fmt::format("<texture type='bitmap' name='reflectance'><string name='filename' "
                       "value='{}'/>{}</texture>",
                       file, more);
}

Textured<Rgb> reflectance_of(const Scene& scene) {
    return std::get<DiffuseBsdf>(scene.materials.at(0).bsdf).reflectance;
}
BitmapTexture bitmap_of(const Scene& scene) {
    return std::get<BitmapTexture>(reflectance_of(scene).texture.texture->kind);
}
glm::dmat3 to_uv_of(const Scene& scene) { return reflectance_of(scene).texture.texture->to_uv; }

} // namespace

TEST_CASE("scene textures: a bitmap has Mitsuba's defaults, and what a file says") {
    BitmapTexture b = bitmap_of(load_with_image(diffuse(bitmap())));
    CHECK(b.filter == TextureFilter::bilinear);
    CHECK(b.wrap == TextureWrap::repeat);
    CHECK_FALSE(b.raw);
    CHECK(b.source.layout == TexelLayout{3, 2, 3, TexelComponent::byte, true});
    b = bitmap_of(load_with_image(diffuse(bitmap(
        "<string name='filter_type' value='nearest'/><string name='wrap_mode' value='mirror'/>"
        "<boolean name='raw' value='true'/><string name='format' value='fp16'/>"))));
    CHECK(b.filter == TextureFilter::nearest);
    CHECK(b.wrap == TextureWrap::mirror);
    CHECK(b.raw);
    b = bitmap_of(load_with_image(diffuse(bitmap("<string name='wrap_mode' value='clamp'/>"))));
    CHECK(b.wrap == TextureWrap::clamp);
}

TEST_CASE("scene textures: to_uv moves and turns in the plane, as in Mitsuba 3") {
    // Printed by Mitsuba 3.9.1 for the same elements: rows 1.73205 -1.5 -0.316987,
    // 1 2.59808 1.54904.
    glm::dmat3 m = to_uv_of(load_with_image(
        diffuse(bitmap("<transform name='to_uv'><translate x='.25' y='.5'/><scale x='2' y='3'/>"
                       "<rotate z='1' angle='30'/></transform>"))));
    const double rows[2][3] = {{1.73205, -1.5, -0.316987}, {1, 2.59808, 1.54904}};
    for (int row = 0; row < 2; row++)
        for (int column = 0; column < 3; column++)
            CHECK(m[column][row] == Approx(rows[row][column]).epsilon(1e-5));
    // Of older versions; printed likewise: 4 0 1, 0 1 0.
    m = to_uv_of(load_with_image(diffuse(bitmap("<float name='uscale' value='4'/>"
                                                "<float name='uoffset' value='0.25'/>")),
                                 "0.6.0"));
    CHECK(m == glm::dmat3(4, 0, 0, 0, 1, 0, 1, 0, 1));
    m = to_uv_of(load_with_image(diffuse(bitmap("<integer name='vscale' value='2'/>"
                                                "<float name='voffset' value='-1'/>")),
                                 "0.6.0"));
    CHECK(m == glm::dmat3(1, 0, 0, 0, 2, 0, 0, -2, 1));
    CHECK_THAT(refusal_with_image(diffuse(bitmap("<float name='uscale' value='4'/>"))),
               Contains("no parameter \"uscale\""));
}

TEST_CASE("scene textures: a texture is referred to, and counts once") {
    Scene scene = load_with_image(
        "<texture type='bitmap' id='t'><string name='filename' value='image.png'/></texture>"
        "<bsdf type='diffuse' id='a'><ref id='t' name='reflectance'/></bsdf>" +
        diffuse("<ref id='t' name='reflectance'/>") + "<shape type='sphere'><ref id='a'/></shape>");
    REQUIRE(scene.materials.size() == 2);
    CHECK(reflectance_of(scene).texture.texture->id == "t");
    CHECK(reflectance_of(scene) == std::get<DiffuseBsdf>(scene.materials[1].bsdf).reflectance);
}

TEST_CASE("scene textures: a checkerboard's colours are constants") {
    auto board = [](const std::string& inside) {
        return std::get<CheckerboardTexture>(
            reflectance_of(load_body(diffuse("<texture type='checkerboard' name='reflectance'>" +
                                             inside + "</texture>")))
                .texture.texture->kind);
    };
    CHECK(board("").color0 == Rgb(0.4));
    CHECK(board("").color1 == Rgb(0.2));
    CHECK(board("<rgb name='color1' value='1 0.5 0'/>").color1 == Rgb(1, 0.5, 0));
    CHECK_THAT(refusal_of_body(diffuse("<texture type='checkerboard' name='reflectance'>"
                                       "<texture type='checkerboard' name='color0'/></texture>")),
               Contains("parameter \"color0\" is given as <texture type=\"checkerboard\">"));
}

TEST_CASE("scene textures: a texture that is the same everywhere is a constant") {
    auto constant = [](const std::string& value) {
        return "<texture type='rawconstant' name='reflectance'>" + value + "</texture>";
    };
    CHECK(reflectance_of(load_body(diffuse(constant("<float name='value' value='0.25'/>")))) ==
          Rgb(0.25));
    CHECK(reflectance_of(load_body(diffuse(
              constant("<vector name='value' x='0.1' y='0.2' z='0.3'/>")))) == Rgb(0.1, 0.2, 0.3));
    CHECK_THAT(refusal_of_body(diffuse(constant("<float name='value' value='1.5'/>"))),
               Contains("\"reflectance\" is 1.5 (accepted: 0 to 1)"));
    CHECK_THAT(refusal_of_body(diffuse(constant(""))), Contains("lacks its parameter \"value\""));
    CHECK_THAT(refusal_of_body(diffuse(constant("<rgb name='value' value='1 1 1'/>"))),
               Contains("given as <rgb>"));
}

TEST_CASE("scene textures: roughness and index, which leave energy compensation out") {
    Scene scene = load_with_image(
        "<shape type='sphere'><bsdf type='roughconductor'><texture type='checkerboard' "
        "name='alpha_u'/><float name='alpha_v' value='0.2'/></bsdf></shape>"
        "<shape type='sphere'><bsdf type='roughdielectric'><texture type='checkerboard' "
        "name='alpha'/></bsdf></shape>"
        "<shape type='sphere'><bsdf type='roughconductor'><texture type='checkerboard' "
        "name='specular_reflectance'/></bsdf></shape><emitter type='constant'/>");
    const auto& metal = std::get<RoughConductorBsdf>(scene.materials[0].bsdf);
    CHECK(metal.roughness.alpha_u.texture);
    CHECK(metal.roughness.alpha_v == 0.2);
    const auto& glass = std::get<RoughDielectricBsdf>(scene.materials[1].bsdf);
    CHECK(glass.roughness.alpha_u.texture);
    CHECK(glass.roughness.alpha_u == glass.roughness.alpha_v);
    REQUIRE(scene.notes.size() == 2);
    CHECK_THAT(scene.notes[0],
               Contains("there is no energy compensation where roughness or index are textures"));
    CHECK_FALSE(wants_energy_compensation(scene.materials[0].bsdf));
    CHECK_FALSE(wants_energy_compensation(scene.materials[1].bsdf));
    CHECK(wants_energy_compensation(scene.materials[2].bsdf));
    // A record's table: 1 + its number, above the bit of the distribution.
    DeviceScene flat = make_device_scene(scene);
    CHECK(flat.materials[0].distribution >> 1 == 0);
    CHECK(flat.materials[1].distribution >> 1 == 0);
    CHECK(flat.materials[2].distribution >> 1 == 1);
}

TEST_CASE("scene textures: refusals name file, line, parameter, and what is accepted") {
    auto refused = [](const std::string& body, const char* part) {
        std::string message = refusal_with_image(body);
        CHECK_THAT(message, Contains("scene.xml:2: ") && Contains(part));
    };
    refused(diffuse(bitmap("", "absent.png")), "file \"absent.png\" not found");
    refused(diffuse(bitmap("", "broken.png")), "broken.png: cannot be read as PNG: the file ends");
    refused(diffuse(bitmap("", "text.png")), "text.png: not an image of a known format (accepted:");
    refused(diffuse("<texture type='bitmap' name='reflectance'/>"),
            "lacks its parameter \"filename\"");
    refused(diffuse(bitmap("<string name='wrap_mode' value='border'/>")),
            "\"wrap_mode\" is \"border\" (accepted: repeat, mirror, clamp)");
    refused(diffuse("<texture type='volume' name='reflectance'/>"),
            "texture plugin \"volume\" is not supported (accepted: bitmap, checkerboard, "
            "mesh_attribute, rawconstant)");
    refused(diffuse("<rgb name='reflectance' value='1 1 1'/>" + bitmap()),
            "parameter \"reflectance\" is given twice");
    refused(diffuse(bitmap() + bitmap()), "parameter \"reflectance\" is given twice");
    refused("<shape type='sphere'><bsdf type='dielectric'><texture type='checkerboard' "
            "name='int_ior'/></bsdf></shape>",
            "parameter \"int_ior\" is given as <texture type=\"checkerboard\">");
    refused("<emitter type='point'><texture type='checkerboard' name='intensity'/></emitter>",
            "parameter \"intensity\" is given as <texture type=\"checkerboard\">");
    refused(diffuse("<texture type='checkerboard' name='color'/>"),
            "cannot hold the texture plugin \"checkerboard\"");
    refused(
        "<texture type='bitmap' id='unused'><string name='filename' value='text.png'/></texture>",
        "not an image");
    // Read with the scene's texels alone: what stands there depends on them.
    SceneFolder folder;
    std::string file = folder.write(
        "scene.xml", scene_text(diffuse("<texture type='checkerboard' name='reflectance'><float "
                                        "name='color0' value='1.5'/></texture>")));
    CHECK_THROWS_WITH(
        make_device_scene(load_scene(file)),
        Contains("scene.xml:2: bsdf plugin \"diffuse\": parameter \"reflectance\" gets "
                 "values from 0.2 to 1.5 of a checkerboard (accepted: 0 to 1)"));
}

TEST_CASE("scene textures: filters that there are not are noted") {
    Scene scene =
        load_with_image(diffuse(bitmap("<string name='filter_type' value='trilinear'/>")));
    CHECK(bitmap_of(scene).filter == TextureFilter::bilinear);
    REQUIRE(scene.notes.size() == 1);
    CHECK_THAT(scene.notes[0], Contains("\"trilinear\" is taken as \"bilinear\""));
}
