// Projectors, and spots that shine through a texture: walls by closed forms, what files say and
// what of that is refused.
#include "host/flatten/light_bounds.h"
#include "host/flatten/light_rows.h"
#include "host/numerics/every_kind_scene.h"
#include "test_scene_tools.h"
#include "tests/support/host_render.h"
#include "tests/support/image_files.h"

#include <catch2/catch.hpp>
#include <fmt/format.h>
#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>

#include <cmath>

using namespace parhelion;
using namespace parhelion::test;
using namespace parhelion::numerics;
using Catch::Contains;

namespace {

constexpr double degree = glm::pi<double>() / 180;

/// 2 x 2 texels, and 4 x 2, no two alike, the top row first.
std::vector<float> texels(int count) {
    std::vector<float> values(static_cast<std::size_t>(count));
    for (std::size_t n = 0; n < values.size(); n++)
        values[n] = 0.25f + 0.5f * static_cast<float>(n);
    return values;
}

/// What scenes look at while they are rendered.
struct Images : SceneFolder {
    Images() {
        write("square.pfm", pfm_of(2, 2, texels(4), 1));
        write("wide.pfm", pfm_of(4, 2, texels(8), 1));
    }
    Scene load(const std::string& body) const {
        return load_scene(write("scene.xml", scene_text(body)));
    }
};

std::string image(const std::string& name, const std::string& file) {
    return fmt::format("<texture name='{}' type='bitmap'><string name='filename' value='{}'/>"
                       "<string name='filter_type' value='nearest'/></texture>",
                       name, file);
}
std::string emitter(const std::string& type, const std::string& inside) {
    return fmt::format("<emitter type='{}'>\n{}</emitter>", type, inside);
}
const std::string turned = "<transform name='to_world'><rotate z='1' angle='90'/>"
                           "<translate x='0.5' y='-0.25' z='1'/></transform>";

/// Reflects all of what it gets. In the plane through (0, 0, 5) that it faces from below.
Scene with_wall(Scene scene, const glm::dvec3& normal) {
    glm::dvec3 u = glm::normalize(glm::cross(normal, {0.1, 1, 0.2})), v = glm::cross(normal, u);
    scene.materials = {{"", {}, DiffuseBsdf{Rgb(1)}}};
    scene.shapes.push_back(
        shape_of(quad(glm::dvec3(0, 0, 5) - 20.0 * (u + v), 40.0 * u, 40.0 * v), 0, no_material));
    return scene;
}

/// Of a point of the wall, by what a film about it sees that is next to nothing wide.
double shown(Scene scene, const glm::dvec3& at, const char* channel = "R") {
    scene.camera.orthographic = true;
    scene.camera.to_world = glm::dmat4(glm::dvec4(1e-6, 0, 0, 0), glm::dvec4(0, 1e-6, 0, 0),
                                       glm::dvec4(0, 0, 1, 0), glm::dvec4(at.x, at.y, -50, 1));
    scene.film.width = scene.film.crop_width = scene.film.height = scene.film.crop_height = 1;
    scene.film.filter.kind = FilterKind::box;
    scene.integrator.max_depth = 2;
    scene.sampler.samples_per_pixel = 1;
    Image picture = host_render(scene, Precision::double_precision).image;
    return find_channel(picture, channel)->values[0];
}

const glm::dvec3 facing(0, 0, -1), tilted = glm::normalize(glm::dvec3(0.3, -0.2, -1));

/// On the plane of the wall above (x, y).
glm::dvec3 on_wall(const glm::dvec3& normal, double x, double y) {
    return {x, y, 5 - (normal.x * x + normal.y * y) / normal.z};
}

/// A projector at the origin of its own frame, x to the left and y up, sends E pi/(z^2 cos) on to
/// what faces it at a point whose depth is z, under that angle with its axis.
double projected(double irradiance, const glm::dvec3& local, double wall_cosine) {
    double cosine = local.z / glm::length(local);
    return irradiance / (local.z * local.z * cosine) * wall_cosine;
}

} // namespace

TEST_CASE("Projectors: a wall shows the irradiance over the square of its distance", "[emitter]") {
    Images images;
    Scene plain = images.load(
        emitter("projector", "<float name='fov' value='60'/><rgb name='irradiance' value='2 3 5'/>"
                             "<float name='scale' value='7'/>" +
                                 turned));
    double half = 4 * std::tan(30 * degree); // at the wall that it faces
    for (const glm::dvec3& normal : {facing, tilted}) {
        Scene scene = with_wall(plain, normal);
        for (double x : {-2.2, -0.3, 0.5, 1.9, 2.6})
            for (double y : {-2.4, -0.25, 1.1, 1.9, 2.2}) {
                CAPTURE(normal.x, x, y);
                glm::dvec3 p = on_wall(normal, x, y), local(p.y + 0.25, -(p.x - 0.5), p.z - 1);
                double cosine = -glm::dot(glm::normalize(p - glm::dvec3(0.5, -0.25, 1)), normal);
                double edge = half * local.z / 4;
                bool inside = std::abs(local.x) < edge && std::abs(local.y) < edge;
                double expected = inside ? projected(14, local, cosine) : 0;
                CHECK(shown(scene, p) == Approx(expected).epsilon(1e-5).margin(1e-9));
                CHECK(shown(scene, p, "B") == Approx(2.5 * expected).epsilon(1e-5).margin(1e-9));
            }
    }
}

TEST_CASE("Projectors: a picture stands upright, its first texel at +x and +y", "[emitter]") {
    Images images;
    struct Picture {
        const char *file, *axis;
        int columns;
        double half_width, half_height; ///< at unit distance
    };
    const double t = std::tan(25 * degree);
    const Picture pictures[] = {
        {"square.pfm", "x", 2, t, t},
        {"wide.pfm", "x", 4, t, t / 2},
        {"wide.pfm", "y", 4, 2 * t, t},
        {"wide.pfm", "smaller", 4, 2 * t, t},
        {"wide.pfm", "larger", 4, t, t / 2},
        {"wide.pfm", "diagonal", 4, t * 2 / std::sqrt(5), t / std::sqrt(5)}};
    for (bool mirrored : {false, true})
        for (const Picture& picture : pictures) {
            std::string mirror =
                mirrored ? "<transform name='to_world'><scale x='-1'/></transform>" : "";
            Scene scene = with_wall(
                images.load(emitter(
                    "projector", "<float name='fov' value='50'/><string name='fov_axis' value='" +
                                     std::string(picture.axis) + "'/>" +
                                     image("irradiance", picture.file) + mirror)),
                facing);
            for (int column = -1; column <= picture.columns; column++)
                for (int row = -1; row <= 2; row++) {
                    CAPTURE(picture.file, picture.axis, mirrored, column, row);
                    double u = (column + 0.7) / picture.columns, v = (row + 0.4) / 2;
                    double x = 5 * picture.half_width * (1 - 2 * u) * (mirrored ? -1 : 1),
                           y = 5 * picture.half_height * (1 - 2 * v);
                    bool inside = u > 0 && u < 1 && v > 0 && v < 1;
                    double texel = 0.25 + 0.5 * (row * picture.columns + column);
                    CHECK(shown(scene, {x, y, 5}) ==
                          Approx(inside ? texel / 25 : 0).epsilon(1e-5).margin(1e-9));
                }
        }
}

TEST_CASE("Spots: a texture fills the square about the cone, u along +x and v along +y",
          "[emitter]") {
    Images images;
    Scene scene = with_wall(images.load(emitter("spot", "<float name='cutoff_angle' value='40'/>"
                                                        "<float name='beam_width' value='40'/>"
                                                        "<rgb name='intensity' value='3 4 6'/>" +
                                                            image("texture", "wide.pfm") + turned)),
                            facing);
    const double half = 4 * std::tan(40 * degree);
    for (int column = 0; column < 4; column++)
        for (int row = 0; row < 2; row++) {
            CAPTURE(column, row);
            double x = half * (2 * (column + 0.6) / 4 - 1), y = half * (2 * (row + 0.7) / 2 - 1);
            double tangent = std::hypot(x, y) / 4, cosine = 1 / std::sqrt(1 + tangent * tangent);
            bool inside = std::hypot(x, y) < half;
            double texel = inside ? 0.25 + 0.5 * (row * 4 + column) : 0;
            double expected = texel * 4 / (16 * glm::pi<double>()) * std::pow(cosine, 3);
            // Turned by 90 degrees, x goes to y and y to -x.
            CHECK(shown(scene, {0.5 - y, -0.25 + x, 5}, "G") ==
                  Approx(expected).epsilon(1e-5).margin(1e-9));
        }
}

TEST_CASE("Projectors: their share of the light is that of what goes through the frame",
          "[emitter]") {
    Images images;
    Scene scene = with_wall(
        images.load(emitter("projector",
                            "<float name='fov' value='50'/>" + image("irradiance", "wide.pfm")) +
                    emitter("spot", image("texture", "square.pfm")) +
                    "<emitter type='point'><point name='position' x='0' y='0' z='3'/></emitter>"),
        facing);
    DeviceScene device = make_device_scene(scene);
    std::vector<std::string> notes;
    std::vector<LightRow> rows = light_rows(scene, device, notes);
    REQUIRE(rows.size() == 3);
    const double t = std::tan(25 * degree), mean = 2.0, spot_mean = 1.0;
    const double cone = 2 * glm::pi<double>() * (1 - std::cos(17.5 * degree));
    const double powers[] = {glm::pi<double>() * mean * 2 * t * t, spot_mean * cone,
                             4 * glm::pi<double>()};
    const double all = powers[0] + powers[1] + powers[2];
    for (std::size_t i = 0; i < 3; i++)
        CHECK(device.lights[i].pmf == Approx(powers[i] / all).epsilon(1e-6));
    LightBounds bounds = light_bounds(rows[0]);
    CHECK(bounds.cos_spread == Approx(1 / std::sqrt(1 + 1.25 * t * t)));
    CHECK(glm::length(bounds.axis - glm::dvec3(0, 0, 1)) < 1e-12);
    // Of light that leaves within the frame's solid angle, by the midpoint rule.
    double seen = 0;
    for (int i = 0; i < 500; i++)
        for (int j = 0; j < 500; j++) {
            double x = t * ((i + 0.5) / 250 - 1), y = t / 2 * ((j + 0.5) / 250 - 1);
            seen += std::pow(1 + x * x + y * y, -1.5) * (2 * t / 500) * (t / 500);
        }
    CHECK(bounds.intensity == Approx(bounds.power / seen).epsilon(1e-5));
}

TEST_CASE("Projectors: kernels have what they need, and nothing of surfaces' textures",
          "[emitter]") {
    Images images;
    Scene scene = with_wall(images.load(emitter("projector", "<float name='fov' value='50'/>" +
                                                                 image("irradiance", "wide.pfm"))),
                            facing);
    std::get<Mesh>(scene.shapes[0].geometry).uvs = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
    FeatureSet on = make_device_scene(scene).features.on();
    for (Feature some : {feature_emitter_projector, feature_projected_textures,
                         feature_texture_bitmap, feature_texels_single})
        CHECK(on.has(some));
    for (Feature none : {feature_textures, feature_textured_lights, feature_vertex_uvs,
                         feature_emitter_spot, feature_emission})
        CHECK(!on.has(none));
    std::get<ProjectorEmitter>(scene.emitters[0]).slide.texture = {};
    on = make_device_scene(scene).features.on();
    CHECK(on.has(feature_emitter_projector));
    CHECK(!on.has(feature_projected_textures));
    CHECK(!on.has(feature_texture_bitmap));
    // Nothing is read for views of geometry.
    scene.integrator.kind = IntegratorKind::normals;
    CHECK(make_device_scene(scene).textures.empty());
}

TEST_CASE("Projectors: what files say without numbers", "[emitter]") {
    auto plain = std::get<ProjectorEmitter>(load_body(emitter("projector", "")).emitters.at(0));
    CHECK(plain.irradiance == Rgb(1));
    CHECK(!plain.slide.texture);
    // 50 mm before the diagonal of a 24 x 36 mm film, on a square.
    double width = std::hypot(24, 36) / 50 / std::sqrt(2);
    CHECK(glm::length(plain.slide.across - glm::dvec3(-1 / width, 0, 0)) < 1e-12);
    CHECK(glm::length(plain.slide.down - glm::dvec3(0, -1 / width, 0)) < 1e-12);
    // The same everywhere is no texture.
    Scene same = load_body(
        emitter("spot", "<texture name='texture' type='rawconstant'><float name='value' value='3'/>"
                        "</texture>"));
    CHECK(std::get<SpotEmitter>(same.emitters.at(0)).intensity == Rgb(3));
}

TEST_CASE("Projectors: what cannot be one is refused with its line", "[emitter]") {
    auto refused = [](const std::string& type, const std::string& inside) {
        return refusal_of_body(emitter(type, inside));
    };
    for (const char* fov : {"0", "180", "-5", "200"})
        CHECK_THAT(refused("projector", fmt::format("<float name='fov' value='{}'/>", fov)),
                   Contains("scene.xml:3") && Contains("less than 180"));
    const std::string attribute =
        "type='mesh_attribute'><string name='name' value='vertex_color'/></texture>";
    const struct {
        const char* type;
        std::string inside, place, what;
    } cases[] = {
        {"projector", image("irradiance", "none.pfm"), "scene.xml:3", "none.pfm"},
        {"projector", "<float name='scale' value='-1'/>", "scene.xml:3", "scale"},
        {"projector", "<float name='near_clip' value='1'/>", "scene.xml:3", "near_clip"},
        {"projector", "<float name='fov' value='9'/>\n<string name='focal_length' value='50mm'/>",
         "scene.xml:4", "one or the other"},
        {"projector", "<transform name='to_world'><scale x='2'/></transform>", "scene.xml:3",
         "deforms the picture"},
        {"projector", "<texture name='irradiance' " + attribute, "scene.xml:3",
         "accepted: bitmap, checkerboard"},
        {"spot", "<texture name='texture' " + attribute, "scene.xml:3",
         "accepted: bitmap, checkerboard"},
        {"spot",
         "<float name='cutoff_angle' value='90'/>\n<texture name='texture' type='checkerboard'/>",
         "scene.xml:3", "less than 90 degrees"},
        {"spot", "<texture name='intensity' type='checkerboard'/>", "scene.xml:3", "intensity"},
    };
    for (const auto& c : cases)
        CHECK_THAT(refused(c.type, c.inside), Contains(c.place) && Contains(c.what));
    Scene dark = load_body(emitter("projector", "<texture name='irradiance' type='checkerboard'>"
                                                "<float name='color0' value='-1'/></texture>"));
    CHECK_THROWS_WITH(make_device_scene(dark),
                      Contains("scene.xml:3") && Contains("\"irradiance\" gets values from -1"));
}
