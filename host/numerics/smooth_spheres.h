// Scenes of coarse spheres with smooth normals, one above the other: where shading normals and
// geometry differ most.
#pragma once

#include "host/image/image.h"
#include "host/numerics/every_kind_scene.h"
#include "host/scene/scene.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace parhelion::numerics {

/// Takes away the faces towards +x: light from there that gets below another face arrives.
inline void open_to_the_right(Mesh& m) {
    std::erase_if(m.triangles, [&](const glm::uvec3& t) {
        return m.positions[t.x].x + m.positions[t.y].x + m.positions[t.z].x > 0;
    });
}

/// An icosahedron whose faces are cut in four, with the normals of the sphere of radius 1.
inline Mesh coarse_sphere() {
    Mesh m;
    const double t = (1.0 + std::sqrt(5.0)) / 2.0;
    m.positions = {{-1, t, 0},  {1, t, 0},  {-1, -t, 0}, {1, -t, 0}, {0, -1, t},  {0, 1, t},
                   {0, -1, -t}, {0, 1, -t}, {t, 0, -1},  {t, 0, 1},  {-t, 0, -1}, {-t, 0, 1}};
    const glm::uvec3 faces[] = {{0, 11, 5}, {0, 5, 1},  {0, 1, 7},   {0, 7, 10}, {0, 10, 11},
                                {1, 5, 9},  {5, 11, 4}, {11, 10, 2}, {10, 7, 6}, {7, 1, 8},
                                {3, 9, 4},  {3, 4, 2},  {3, 2, 6},   {3, 6, 8},  {3, 8, 9},
                                {4, 9, 5},  {2, 4, 11}, {6, 2, 10},  {8, 6, 7},  {9, 8, 1}};
    std::map<std::pair<unsigned, unsigned>, unsigned> middles;
    auto middle = [&](unsigned a, unsigned b) {
        std::pair<unsigned, unsigned> edge = std::minmax(a, b);
        auto [at, is_new] = middles.try_emplace(edge, static_cast<unsigned>(m.positions.size()));
        if (is_new) m.positions.push_back(m.positions[a] + m.positions[b]);
        return at->second;
    };
    for (const glm::uvec3& f : faces) {
        unsigned a = middle(f.x, f.y), b = middle(f.y, f.z), c = middle(f.z, f.x);
        for (const glm::uvec3& part : {glm::uvec3(f.x, a, c), {f.y, b, a}, {f.z, c, b}, {a, b, c}})
            m.triangles.push_back(part);
    }
    for (glm::dvec3& p : m.positions)
        p = glm::normalize(p);
    m.normals = m.positions;
    return m;
}

/// A material and its name in the report.
struct NamedBsdf {
    std::string name;
    Bsdf bsdf;
    bool transparent = false;
};

/// Of all kinds, without loss but for single scattering.
inline std::vector<NamedBsdf> white_bsdfs() {
    using enum MicrofacetDistribution;
    auto metal = [](double alpha) {
        return RoughConductorBsdf{{ggx, alpha, alpha}, {Rgb(0), Rgb(1)}, Rgb(1)};
    };
    return {{"diffuse", DiffuseBsdf{Rgb(1)}},
            {"mirror", ConductorBsdf{{Rgb(0), Rgb(1)}, Rgb(1)}},
            {"metal, GGX 0.1", metal(0.1)},
            {"metal, GGX 0.5", metal(0.5)},
            {"glass", DielectricBsdf{}, true},
            {"glass, GGX 0.3", RoughDielectricBsdf{{ggx, 0.3, 0.3}, 1.5, Rgb(1), Rgb(1)}, true}};
}

enum class Spheres { closed, open_to_the_right };

/// Sphere k fills rows k * size to (k + 1) * size of the image, in front of nothing.
inline Scene smooth_spheres(const std::vector<NamedBsdf>& bsdfs, Spheres spheres, int size,
                            int spp) {
    Scene scene;
    scene.file = "made by the tests of numerics";
    const double step = 2.2, distance = 100, middle = 0.5 * static_cast<double>(bsdfs.size() - 1);
    for (std::size_t k = 0; k < bsdfs.size(); k++) {
        Shape shape;
        Mesh mesh = coarse_sphere();
        if (spheres == Spheres::open_to_the_right) open_to_the_right(mesh);
        for (glm::dvec3& p : mesh.positions)
            p.y += step * (middle - static_cast<double>(k));
        shape.geometry = std::move(mesh);
        shape.material_front = static_cast<int>(k);
        shape.material_back = bsdfs[k].transparent ? static_cast<int>(k) : no_material;
        scene.shapes.push_back(std::move(shape));
        scene.materials.push_back({"", {}, bsdfs[k].bsdf});
    }
    scene.camera.to_world = glm::dmat4(glm::dvec4(-1, 0, 0, 0), glm::dvec4(0, 1, 0, 0),
                                       glm::dvec4(0, 0, -1, 0), glm::dvec4(0, 0, distance, 1));
    scene.camera.fov_degrees = 360 / M_PI * std::atan(0.5 * step / distance);
    Film& film = scene.film;
    film.width = film.crop_width = size;
    film.height = film.crop_height = size * static_cast<int>(bsdfs.size());
    film.filter.kind = FilterKind::box;
    scene.sampler.samples_per_pixel = spp;
    scene.sampler.pattern = SamplePattern::independent;
    return scene;
}

inline constexpr double near_panel = 12, far_panel = 100;

/// The corners of a panel to the right of the spheres, out of sight.
inline std::vector<glm::dvec3> panel_corners(double distance) {
    const double half_height = 8, half_width = 4;
    return {{distance, -half_height, -half_width},
            {distance, -half_height, half_width},
            {distance, half_height, half_width},
            {distance, half_height, -half_width}};
}

/// Shines towards the spheres.
inline void add_panel(Scene& scene, double distance) {
    std::vector<glm::dvec3> c = panel_corners(distance);
    scene.shapes.push_back(
        shape_of(quad(c[0], c[1] - c[0], c[3] - c[0]), no_material, no_material, Rgb(10)));
}

inline const std::vector<float>& channel(const Image& image, const std::string& name) {
    return find_channel(image, name)->values;
}

/// Pixels of which the whole far panel is below the face, in the rows of one sphere; an image of
/// one sample a pixel with the layers `ng` and `p`.
struct TurnedAway {
    int dark = 0, lit = 0;
};

inline TurnedAway turned_away(const Image& image, int sphere) {
    TurnedAway count;
    int size = image.width, first = sphere * size * size;
    for (int i = first; i < first + size * size; i++) {
        auto at = static_cast<std::size_t>(i);
        auto layer = [&](const std::string& name) {
            return glm::dvec3(channel(image, name + ".X")[at], channel(image, name + ".Y")[at],
                              channel(image, name + ".Z")[at]);
        };
        glm::dvec3 ng = layer("ng"), p = layer("p");
        // The place is right to 1e-6.
        auto below = [&](const glm::dvec3& q) { return glm::dot(q - p, ng) < -1e-4; };
        std::vector<glm::dvec3> corners = panel_corners(far_panel);
        if (!std::all_of(corners.begin(), corners.end(), below)) continue;
        (channel(image, "R")[at] > 0 ? count.lit : count.dark)++;
    }
    return count;
}

} // namespace parhelion::numerics
