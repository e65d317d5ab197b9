// A small scene with two different ones of every material, emitter and shape, made from the lists
// of kinds: a kind without an example here does not compile.
//
// Objects stand on a floor under the lights; or all emitters that a ray can meet stand side by
// side, as a panel, and each of them fills a tile of the film.
#pragma once

#include "host/flatten/scene_features.h"
#include "host/numerics/every_kind_scene.h"

#include <array>
#include <cmath>
#include <numbers>
#include <vector>

namespace parhelion::test {

using namespace parhelion::numerics;

// ------------------------------------------------------------------------------------- materials
/// Two of each, `which` of 0, 1.
inline Bsdf example_diffuse(int which) {
    return DiffuseBsdf{which ? Rgb(0.2, 0.6, 0.3) : Rgb(0.6, 0.3, 0.1)};
}
inline Bsdf example_conductor(int which) {
    return ConductorBsdf{{Rgb(0.2, 0.9, 1.1), Rgb(3.9, 2.4, 2.2)}, Rgb(which ? 0.5 : 1.0)};
}
inline Bsdf example_dielectric(int which) {
    DielectricBsdf b;
    if (which) b.eta = 1.3;
    return b;
}
inline Bsdf example_thindielectric(int which) {
    ThinDielectricBsdf b;
    if (which) b.eta = 1.9;
    return b;
}
inline Bsdf example_roughconductor(int which) {
    RoughConductorBsdf b{
        {MicrofacetDistribution::beckmann, 0.3, 0.4}, {Rgb(0.2), Rgb(3.0)}, Rgb(0.9)};
    if (which) b.roughness = {MicrofacetDistribution::ggx, 0.5, 0.5};
    return b;
}
inline Bsdf example_roughdielectric(int which) {
    RoughDielectricBsdf b;
    b.roughness = {MicrofacetDistribution::ggx, 0.6, 0.6};
    if (which) b.roughness = {MicrofacetDistribution::beckmann, 0.4, 0.4};
    return b;
}
inline Bsdf example_null(int) { return NullBsdf{}; }
inline Bsdf example_roughdiffuse(int which) {
    return RoughDiffuseBsdf{Rgb(0.5, 0.4, 0.6), which ? 1.0 : 0.4};
}
inline Bsdf example_plastic(int which) {
    return PlasticBsdf{which ? 1.8 : 1.3, Rgb(0.3, 0.5, 0.7), Rgb(which ? 1.0 : 0.5), which != 0};
}
inline Bsdf example_roughplastic(int which) {
    RoughPlasticBsdf b{{MicrofacetDistribution::beckmann, 0.3}, 1.3, Rgb(0.7, 0.5, 0.3), Rgb(0.8)};
    if (which) b = {{MicrofacetDistribution::ggx, 0.2}, 1.8, Rgb(0.5), Rgb(1.0), true};
    return b;
}

inline Bsdf example_principled(int which) {
    PrincipledBsdf b;
    b.base_color = Rgb(0.3, 0.6, 0.5), b.roughness = 0.6, b.metallic = 0.4, b.spec_tint = 0.5;
    b.sheen = 0.7, b.sheen_tint = 0.4, b.clearcoat = 0.8, b.flatness = 0.3;
    if (which) b.spec_trans = 0.7, b.eta = 1.4, b.anisotropic = 0.5, b.clearcoat_gloss = 0.3;
    return b;
}
inline Bsdf example_principledthin(int which) {
    PrincipledThinBsdf b;
    b.base_color = Rgb(0.5, 0.6, 0.3), b.roughness = 0.5, b.diff_trans = 0.9, b.sheen = 0.6;
    if (which) b.spec_trans = 0.6, b.spec_tint = 0.3, b.eta = 1.7, b.flatness = 0.5;
    return b;
}

inline Bsdf example_phong(int which) {
    PhongBsdf b{20.0, Rgb(0.3, 0.5, 0.2), Rgb(0.4)};
    if (which) b = {3.0, Rgb(0.8), Rgb(0.3, 0.6, 0.5)}; // scaled down
    return b;
}
inline Bsdf example_ward(int which) {
    WardBsdf b{{WardVariant::balanced, 0.3, 0.5}, Rgb(0.3, 0.2, 0.5), Rgb(0.5)};
    if (which) b = {{WardVariant::ward, 0.4, 0.4}, Rgb(0.2), Rgb(0.3, 0.6, 0.5)};
    return b;
}

using Example = Bsdf (*)(int);
#define EXAMPLE_MATERIAL(name, ...) example_##name,
inline constexpr std::array example_materials{MATERIALS(EXAMPLE_MATERIAL)};
inline bool is_opaque(std::size_t kind) { return (OPAQUE_MATERIALS >> kind) & 1; }

/// Whether rough ones make up for what they scatter more than once; the tables for it take longer
/// than a small image.
inline void set_energy_compensation(Scene& scene, bool on) {
    for (Material& m : scene.materials) {
        std::visit(
            [on](auto& b) {
                if constexpr (requires { b.energy_compensation; }) b.energy_compensation = on;
            },
            m.bsdf);
    }
}

// ---------------------------------------------------------------------------------------- shapes
inline Geometry example_triangle(glm::dvec3 at, int which) {
    Mesh m = quad(at - glm::dvec3(0.3, 0.3, 0), {0.6, 0.1, 0.1}, {0, 0.6, which ? 0.3 : -0.2});
    for (const glm::dvec3& p : m.positions)
        m.normals.push_back(glm::normalize(0.4 * (p - at) + glm::dvec3(0, 0, 1)));
    m.uvs = {{0, 0}, {1, 0.1}, {1, 1}, {0.2, 1}};
    return m;
}
inline Geometry example_sphere(glm::dvec3 at, int which) { return Sphere{at, which ? 0.25 : 0.35}; }
inline Geometry example_disk(glm::dvec3 at, int which) {
    // The first shows its back.
    return Disk{at, {0.3, 0, which ? 0.1 : 0.0}, {0, 0.35, 0.1}, which == 0};
}
inline Geometry example_cylinder(glm::dvec3 at, int which) {
    // The first shows its inside as well.
    Cylinder c{at - glm::dvec3(0.1, 0.3, which ? 0.0 : 0.2), {0.2, 0.6, which ? 0.1 : 0.4}};
    c.side = 0.25 * glm::normalize(glm::cross(c.axis, glm::dvec3(1, 0, 0.3)));
    c.mirrored = which;
    return c;
}
using ExampleShape = Geometry (*)(glm::dvec3, int);
#define EXAMPLE_GEOMETRY(name) example_##name,
inline constexpr std::array example_shapes{GEOMETRIES(EXAMPLE_GEOMETRY)};

// ---------------------------------------------------------------------------------------- lights
// Emitters that are surfaces are black, so that what is seen of them is their own light.
constexpr int black_material = 2 * material_kind_count;

/// Where lights are: over the objects, shining down; or side by side, shining along -z.
enum class Where { room, panel };
constexpr double panel_z = 30;

struct LampPlace {
    glm::dvec3 at, u, v; ///< cross(u, v): the way it shines
};
inline LampPlace lamp_place(EmitterKind kind, int which, Where where) {
    int n = 2 * int(kind) + which;
    if (where == Where::panel) return {{n - 4, 0, panel_z}, {0, 0.98, 0}, {0.98, 0, 0}};
    return {{0.7 * n - 2.6, 2 + 0.2 * which, 0.3 * int(kind) - 0.5}, {0.3, 0, 0}, {0, 0.05, 0.3}};
}

inline void add_lamp(Scene& scene, Geometry geometry, Rgb radiance) {
    scene.shapes.push_back(shape_of(std::move(geometry), black_material, no_material, radiance));
}
inline void add_area_triangle(Scene& scene, int which, Rgb power, Where where) {
    auto [at, u, v] = lamp_place(emitter_area_triangle, which, where);
    // So tall on the panel that it is as wide as its tile.
    double tall = where == Where::panel ? 20 : 1.2;
    glm::dvec3 corner = at - 0.1 * tall * u - 0.49 * v;
    Mesh m;
    m.positions = {corner, corner + tall * u, corner + (which ? 0.95 : 0.98) * v};
    m.triangles = {{0, 1, 2}};
    add_lamp(scene, m, power);
}
inline void add_area_parallelogram(Scene& scene, int which, Rgb power, Where where) {
    auto [at, u, v] = lamp_place(emitter_area_parallelogram, which, where);
    add_lamp(scene, quad(at - 0.5 * (u + v), u, (which ? 0.9 : 1.0) * v), power);
}
inline void add_area_sphere(Scene& scene, int which, Rgb power, Where where) {
    LampPlace p = lamp_place(emitter_area_sphere, which, where);
    add_lamp(scene, Sphere{p.at, (which ? 0.45 : 0.48) * glm::length(p.u)}, power);
}
inline void add_area_disk(Scene& scene, int which, Rgb power, Where where) {
    auto [at, u, v] = lamp_place(emitter_area_disk, which, where);
    add_lamp(scene, Disk{at, 0.48 * u, (which ? 0.45 : 0.48) * v}, power);
}
/// It fills no tile of the panel.
inline void add_area_cylinder(Scene& scene, int which, Rgb power, Where) {
    Cylinder c{{which ? 1.5 : -1.9, 1.9, 0.5}, {0.4, 0.1 * which, 0.2}};
    c.side = 0.06 * glm::normalize(glm::cross(c.axis, glm::dvec3(0, 1, 0)));
    add_lamp(scene, c, power);
}
inline void add_point(Scene& scene, int which, Rgb power, Where) {
    scene.emitters.push_back(PointEmitter{{which - 0.3, 1.5, 1.8}, power});
}
inline void add_spot(Scene& scene, int which, Rgb power, Where) {
    scene.emitters.push_back(SpotEmitter{
        {2.0 * which - 1, 2, 2}, glm::normalize(glm::dvec3(0.3, -1, -0.8)), 0.5, 0.3, power});
}
inline void add_directional(Scene& scene, int which, Rgb power, Where) {
    scene.emitters.push_back(
        DirectionalEmitter{glm::normalize(glm::dvec3(0.4 * which, -1, -0.5)), power});
}
inline void add_projector(Scene& scene, int which, Rgb power, Where) {
    glm::dvec3 n = glm::normalize(glm::dvec3(-0.2, -1, -0.6)), u = glm::cross(n, {0, 0, 1});
    Slide slide{0.6 * glm::normalize(u), 0.8 * glm::normalize(glm::cross(n, u)), {}};
    if (which) slide.down *= -0.5; // mirrored
    scene.emitters.push_back(ProjectorEmitter{{1.2 - 2.0 * which, 2.2, 1.5}, n, slide, power});
}
/// There is one sky: its second example takes the place of its first, and an image that of both
/// (example_sky.h).
inline void add_constant(Scene& scene, int, Rgb power, Where) {
    scene.emitters.push_back(ConstantEmitter{power});
}

constexpr double tiny_side = 1e-5;
/// So small that its corners cannot be told apart from the camera; it fills no tile of the panel.
inline void add_area_tiny_triangle(Scene& scene, int which, Rgb power, Where) {
    constexpr double side = tiny_side;
    glm::dvec3 at(which ? 1.2 : -1.4, 1.6, 0.7);
    Mesh m;
    m.positions = {at, at + glm::dvec3(side, 0, 0), at + glm::dvec3(0, 0.2 * side, side)};
    m.triangles = {{0, 1, 2}};
    add_lamp(scene, m, power);
}
struct LightKind {
    const char* name;
    Feature feature;
    void (*add)(Scene&, int which, Rgb power, Where);
    int examples() const { return feature == feature_emitter_constant ? 1 : 2; }
};
#define LIGHT_KIND(name, ...) LightKind{#name, feature_emitter_##name, add_##name},
inline constexpr std::array light_kinds{EMITTERS_BY_ROW(LIGHT_KIND)};

struct Light {
    std::size_t kind;
    int which;
    Rgb power; ///< no two are alike
};
inline std::vector<Light> example_lights() {
    std::vector<Light> lights;
    for (std::size_t kind = 0; kind < light_kinds.size(); kind++)
        for (int which = 0; which < light_kinds[kind].examples(); which++) {
            auto n = static_cast<double>(lights.size());
            double scale = kind < emitter_point                 ? 4
                           : kind < emitter_directional         ? 1
                           : kind <= emitter_constant           ? 0.1
                           : kind == emitter_area_tiny_triangle ? 4 / (tiny_side * tiny_side)
                           : kind == emitter_projector          ? 1
                                                                : 4;
            lights.push_back({kind, which, scale * Rgb(1 + 0.2 * n, 3 - 0.15 * n, 1 + which)});
        }
    return lights;
}
inline void add_light(Scene& scene, const Light& light, Where where = Where::room) {
    light_kinds[light.kind].add(scene, light.which, light.power, where);
}

// ----------------------------------------------------------------------------------------- scenes
/// Floor, wall, and an object of each example of a material, shapes in turn.
inline void add_objects(Scene& scene) {
    for (Example example : example_materials)
        for (int which : {0, 1})
            scene.materials.push_back({"", {}, example(which)});
    scene.materials.push_back({"", {}, DiffuseBsdf{Rgb(0)}});
    scene.shapes.push_back(shape_of(quad({-4, -1, -4}, {0, 0, 8}, {8, 0, 0}), 0, 0));
    scene.shapes.push_back(shape_of(quad({-4, -1, -2}, {8, 0, 0}, {0, 5, 0}), 1, no_material));
    for (int k = 0; k < 2 * material_kind_count; k++) {
        int row = k / 7;
        glm::dvec3 at(-2.4 + 0.8 * (k % 7), -0.5 + 0.9 * row, -0.4 * row);
        auto make = example_shapes[static_cast<std::size_t>(k) % example_shapes.size()];
        bool opaque = is_opaque(static_cast<std::size_t>(k / 2));
        // Every other opaque one is black from behind.
        scene.shapes.push_back(shape_of(make(at, k % 2), k, opaque && k % 2 ? no_material : k));
    }
}
constexpr std::size_t object_count = 2 + 2 * material_kind_count;

inline Scene objects_scene() {
    Scene scene;
    scene.file = "made by the test";
    add_objects(scene);
    scene.camera.to_world = glm::dmat4(glm::dvec4(-1, 0, 0, 0), glm::dvec4(0, 1, 0, 0),
                                       glm::dvec4(0, 0, -1, 0), glm::dvec4(0, 0.4, 6, 1));
    scene.camera.fov_degrees = 45;
    scene.film.width = scene.film.crop_width = 8;
    scene.film.height = scene.film.crop_height = 6;
    scene.film.pixel_format = PixelFormat::rgba;
    scene.film.filter.kind = FilterKind::box;
    scene.integrator.max_depth = 4;
    scene.sampler.samples_per_pixel = 16;
    return scene;
}

/// Objects under all lights.
inline Scene two_of_every() {
    Scene scene = objects_scene();
    for (const Light& light : example_lights())
        add_light(scene, light);
    return scene;
}

/// The panel, its objects behind the camera: light n fills tile n of the film, the sky the last.
constexpr int tile_pixels = 9, panel_tiles = 9;
inline Scene panel_scene() {
    Scene scene = objects_scene();
    for (const Light& light : example_lights())
        add_light(scene, light, Where::panel);
    scene.camera.to_world = glm::dmat4(glm::dvec4(1, 0, 0, 0), glm::dvec4(0, 1, 0, 0),
                                       glm::dvec4(0, 0, 1, 0), glm::dvec4(0, 0, 10, 1));
    scene.camera.fov_degrees =
        360 / std::numbers::pi * std::atan(0.5 * panel_tiles / (panel_z - 10));
    scene.film.width = scene.film.crop_width = tile_pixels * panel_tiles;
    scene.film.height = scene.film.crop_height = 5;
    scene.sampler.samples_per_pixel = 2;
    return scene;
}
/// From the camera to the panel; as far beyond the objects where it looks at those.
inline double view_distance(const Scene& scene) {
    bool at_panel = scene.camera.to_world[2].z > 0;
    return std::abs(scene.camera.to_world[3].z - (at_panel ? panel_z : -14));
}
/// The pixel in the middle of a tile; image x runs along -x.
inline std::size_t tile_centre(int tile) {
    int x = tile_pixels * (panel_tiles - 1 - tile) + tile_pixels / 2;
    int y = 2;
    return static_cast<std::size_t>(y) * (tile_pixels * panel_tiles) + static_cast<std::size_t>(x);
}

} // namespace parhelion::test
