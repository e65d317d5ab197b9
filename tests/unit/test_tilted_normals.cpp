// Normals that textures tilt: what files say, and a plane that is lit as one that is turned.
#include "host/render/host_render.h"
#include "host/shared_maths.h"
#include "tests/support/first_hits.h"

#include <catch2/catch.hpp>
#include <fmt/format.h>

#include <cmath>
#include <cstring>
#include <numbers>
#include <string>
#include <vector>

using namespace parhelion;
using namespace parhelion::test;
using Catch::Matchers::Contains;

namespace {

std::string pfm(const std::string& kind, int width, const std::vector<float>& values) {
    std::string bytes(values.size() * sizeof(float), '\0');
    std::memcpy(bytes.data(), values.data(), bytes.size());
    return fmt::format("{}\n{} 1\n-1.0\n", kind, width) + bytes;
}

std::string texture(const char* file) {
    return fmt::format("<texture type='bitmap' name='normalmap'><string name='filename' "
                       "value='{}'/></texture>",
                       file);
}
const std::string matte = "<bsdf type='diffuse'><float name='reflectance' value='0.5'/></bsdf>";
std::string bsdf(const char* type, const std::string& inside) {
    return fmt::format("<bsdf type='{}'>{}</bsdf>", type, inside);
}
const std::string unshadowed = "<boolean name='use_shadowing_function' value='false'/>";

/// Images beside the scene: heights rise by 0.5 from u = 1/4 to 3/4; normals are along (0.6, 0,
/// 0.8), a steep one beside.
Scene loaded(const SceneFolder& folder, const std::string& body) {
    folder.write("heights.pfm", pfm("Pf", 2, {0.25f, 0.75f}));
    folder.write("normals.pfm", pfm("PF", 1, {0.8f, 0.5f, 0.9f}));
    folder.write("steep.pfm", pfm("PF", 1, {0.98f, 0.5f, 0.6f}));
    Scene scene =
        load_scene(folder.write("scene.xml", "<scene version='3.0.0'>" + body + "</scene>"));
    apply_overrides({}, scene);
    return scene;
}

/// The middle of a square of side 8, of that bsdf, seen along `view` in light of irradiance pi that
/// travels along `light`: its radiance.
double radiance(const std::string& bsdf, glm::dvec3 light, glm::dvec3 view = {0, 0, -1}) {
    SceneFolder folder;
    const glm::dvec3 from = -5.0 * view;
    Scene scene = loaded(
        folder,
        fmt::format(
            "<integrator type='path'><integer name='max_depth' value='2'/></integrator>"
            "<sensor type='orthographic'><transform name='to_world'><scale value='0.1'/><lookat "
            "origin='{},{},{}' target='0,0,0' up='0,1,0'/></transform>"
            "<film type='hdrfilm'><integer name='width' value='4'/><integer name='height' "
            "value='4'/>"
            "<rfilter type='box'/></film></sensor><emitter type='directional'><vector "
            "name='direction' x='{}' y='{}' z='{}'/><rgb name='irradiance' value='{}'/></emitter>"
            "<shape type='rectangle'><transform name='to_world'><scale value='4'/></transform>{}"
            "</shape>",
            from.x, from.y, from.z, light.x, light.y, light.z,
            fmt::format("{0} {0} {0}", std::numbers::pi), bsdf));
    scene.sampler.samples_per_pixel = 1;
    const Image image = host_image(scene);
    return image.channels.front().values[5];
}

const glm::dvec3 from_right = glm::normalize(glm::dvec3(-0.6, 0.1, -0.8)),
                 from_left = glm::normalize(glm::dvec3(0.6, 0.1, -0.8));

/// Of a white half: 0.5 times the cosine.
double lit(const glm::dvec3& normal, const glm::dvec3& light) {
    return 0.5 * std::max(0.0, -glm::dot(glm::normalize(normal), light));
}

} // namespace

TEST_CASE("Tilted normals: a ramp of heights is lit as a plane that rises so", "[tilt]") {
    // 0.5 over half of a side of 8.
    for (double scale : {1.0, 4.0, -2.0})
        for (const glm::dvec3& light : {from_right, from_left}) {
            CAPTURE(scale, light.x);
            std::string text =
                bsdf("bumpmap", texture("heights.pfm") + unshadowed + matte +
                                    fmt::format("<float name='scale' value='{}'/>", scale));
            glm::dvec3 normal(-scale * 0.5 / 4.0, 0, 1);
            CHECK(radiance(text, light) == Approx(lit(normal, light)).epsilon(1e-5));
        }
    std::string none =
        bsdf("bumpmap", texture("heights.pfm") + matte + "<float name='scale' value='0'/>");
    CHECK(radiance(none, from_left) == Approx(lit({0, 0, 1}, from_left)).epsilon(1e-5));
}

TEST_CASE("Tilted normals: a colour is a normal; facets shadow each other", "[tilt]") {
    for (const glm::dvec3& light : {from_right, from_left}) {
        double plain = lit({0.6, 0, 0.8}, light);
        CHECK(radiance(bsdf("normalmap", texture("normals.pfm") + unshadowed + matte), light) ==
              Approx(plain).epsilon(1e-5));
        // tan^2 of the normal 9 / 16, of the light (1 - z^2) / z^2.
        double tangent_squared = (1 - light.z * light.z) / (light.z * light.z);
        double share = 2 / (1 + std::sqrt(1 + 9.0 / 128 * tangent_squared));
        CHECK(radiance(bsdf("normalmap", texture("normals.pfm") + matte), light) ==
              Approx(share * plain).epsilon(1e-5));
    }
}

TEST_CASE("Tilted normals: those turned away from the viewer are turned about the surface's",
          "[tilt]") {
    // Along (0.96, 0, 0.2), which a viewer from the left sees from behind.
    const glm::dvec3 view = glm::normalize(glm::dvec3(0.8, 0, -0.6));
    const std::string kept = "<boolean name='flip_invalid_normals' value='false'/>";
    const std::string inside = texture("steep.pfm") + unshadowed + matte;
    CHECK(radiance(bsdf("normalmap", inside), from_left, view) ==
          Approx(lit({-0.96, 0, 0.2}, from_left)).epsilon(1e-5));
    CHECK(radiance(bsdf("normalmap", kept + inside), from_left, view) == 0);
}

TEST_CASE("Tilted normals: from below within and around twosided", "[tilt]") {
    const glm::dvec3 up(0, 0, 1), light(-from_left.x, from_left.y, -from_left.z);
    const std::string map = texture("normals.pfm") + unshadowed;
    // Around, the normal is that of above, reversed; within, it is mirrored with the surface.
    CHECK(radiance(bsdf("normalmap", map + bsdf("twosided", matte)), light, up) ==
          Approx(lit({-0.6, 0, -0.8}, light)).epsilon(1e-5));
    CHECK(radiance(bsdf("twosided", bsdf("normalmap", map + matte)), light, up) ==
          Approx(lit({0.6, 0, -0.8}, light)).epsilon(1e-5));
}

TEST_CASE("Tilted normals: each part of a blend has its own", "[tilt]") {
    const std::string tilted = bsdf("normalmap", texture("normals.pfm") + unshadowed + matte),
                      heights = bsdf("bumpmap", texture("heights.pfm") + unshadowed + matte +
                                                    "<float name='scale' value='4'/>");
    const std::string both =
        bsdf("blendbsdf", "<float name='weight' value='0.25'/>" + tilted + heights);
    double expected = 0.75 * lit({0.6, 0, 0.8}, from_left) + 0.25 * lit({-0.5, 0, 1}, from_left);
    CHECK(radiance(both, from_left) == Approx(expected).epsilon(1e-5));
    const std::string masked = bsdf("mask", "<float name='opacity' value='0.3'/>" + tilted);
    CHECK(radiance(masked, from_left) == Approx(0.3 * lit({0.6, 0, 0.8}, from_left)).epsilon(1e-5));
}

TEST_CASE("Tilted normals: what cannot be read is refused by name", "[tilt]") {
    auto refusal = [](const std::string& bsdf) {
        try {
            SceneFolder folder;
            loaded(folder, "<shape type='sphere'>" + bsdf + "</shape>");
        } catch (const InputError& error) {
            return std::string(error.what());
        }
        return std::string();
    };
    const std::string normals = texture("normals.pfm"), heights = texture("heights.pfm");
    CHECK(refusal(bsdf("normalmap", normals + matte)).empty());
    CHECK_THAT(refusal(bsdf("normalmap", matte)), Contains("holds 0 textures (accepted: 1)"));
    CHECK_THAT(refusal(bsdf("bumpmap", heights)), Contains("holds 0 bsdfs (accepted: 1)"));
    CHECK_THAT(refusal(bsdf("bumpmap", normals + heights + matte)), Contains("holds 2 textures"));
    CHECK_THAT(refusal(bsdf("bumpmap", "<texture type='checkerboard'/>" + matte)),
               Contains("\"checkerboard\" (accepted: bitmap)"));
    CHECK_THAT(refusal(bsdf("normalmap", heights + matte)), Contains("one component a texel"));
    CHECK_THAT(refusal(bsdf("normalmap", normals + bsdf("bumpmap", heights + matte))),
               Contains("tilted by another texture already"));
}
