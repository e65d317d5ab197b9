// A small scene with every kind of material, emitter and shape, a thin lens and a wide filter;
// nothing in it is regular.
#pragma once

#include "host/scene/scene.h"

#include <glm/geometric.hpp>

namespace parhelion::numerics {

inline Shape shape_of(Geometry geometry, int front, int back, std::optional<Rgb> radiance = {}) {
    Shape s;
    s.geometry = std::move(geometry);
    s.material_front = front, s.material_back = back;
    s.radiance = radiance;
    return s;
}

inline Mesh quad(glm::dvec3 a, glm::dvec3 u, glm::dvec3 v) {
    Mesh m;
    m.positions = {a, a + u, a + u + v, a + v};
    m.triangles = {{0, 1, 2}, {0, 2, 3}};
    return m;
}

inline void add_every_material(Scene& scene) {
#define DEFAULT_BSDF(name, Name, ...) Name##Bsdf{},
    std::vector<Bsdf> bsdfs{MATERIALS(DEFAULT_BSDF)};
    bsdfs[material_diffuse] = DiffuseBsdf{Rgb(0.6, 0.5, 0.4)};
    bsdfs[material_conductor] = ConductorBsdf{{Rgb(0.2, 0.9, 1.1), Rgb(3.9, 2.4, 2.2)}, Rgb(1.0)};
    bsdfs[material_roughconductor] = RoughConductorBsdf{
        {MicrofacetDistribution::beckmann, 0.1, 0.3}, {Rgb(0.2), Rgb(3.0)}, Rgb(0.9)};
    bsdfs[material_roughdielectric] =
        RoughDielectricBsdf{{MicrofacetDistribution::ggx, 0.2, 0.2}, 1.5, Rgb(1.0), Rgb(1.0)};
    bsdfs.emplace_back(DiffuseBsdf{Rgb(0.1, 0.7, 0.3)});
    for (const Bsdf& b : bsdfs)
        scene.materials.push_back({"", {}, b});
}

/// What all the light of an emitter is proportional to, whatever it is called.
inline Rgb& strength_of(Emitter& emitter) {
    auto strength = [](auto& e) -> Rgb& {
        if constexpr (requires { e.intensity; })
            return e.intensity;
        else if constexpr (requires { e.irradiance; })
            return e.irradiance;
        else
            return e.radiance;
    };
    return std::visit(strength, emitter);
}

inline Scene every_kind_scene() {
    Scene scene;
    scene.file = "made by the test";
    add_every_material(scene);
    scene.shapes.push_back(shape_of(quad({-4, -1, -4}, {0, 0, 8}, {8, 0, 0}), 0, 0));
    scene.shapes.push_back(
        shape_of(quad({-4, -1, -2}, {8, 0, 0}, {0, 6, 0}), material_kind_count, no_material));
    for (int k = 1; k < material_kind_count; k++) {
        bool opaque = (OPAQUE_MATERIALS >> k) & 1;
        Sphere s;
        s.center = {-2.1 + 0.8 * k, -0.6 + 0.05 * k, -0.2 * (k % 3)};
        s.radius = 0.38;
        scene.shapes.push_back(shape_of(s, k, opaque ? no_material : k));
    }
    Mesh smooth = quad({-1.5, 0.2, 0.3}, {0.9, 0.1, 0}, {0.1, 0.8, 0.2});
    for (const glm::dvec3& p : smooth.positions)
        smooth.normals.push_back(glm::normalize(p + glm::dvec3(0, 0, 2)));
    smooth.uvs = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
    scene.shapes.push_back(shape_of(smooth, material_roughconductor, 0));
    scene.shapes.push_back(shape_of(Disk{{0.9, 0.9, -0.3}, {0.5, 0, 0.1}, {0, 0.3, 0.2}, true},
                                    material_roughdielectric, material_roughdielectric));
    Mesh lamp = quad({-0.5, 2.5, -0.5}, {1, 0, 0}, {0, 0, 1}); // and a triangle at its side
    lamp.positions.push_back({0.1, 2.6, 1.1});
    lamp.triangles.push_back({3, 2, 4});
    scene.shapes.push_back(shape_of(lamp, 0, no_material, Rgb(9, 8, 7)));
    scene.shapes.push_back(shape_of(Sphere{{2.2, 1.5, 0.4}, 0.2}, 0, no_material, Rgb(20, 10, 5)));
    scene.shapes.push_back(
        shape_of(Disk{{-2, 1.8, 0.5}, {0.3, 0, 0}, {0, 0.2, 0.3}}, 0, no_material, Rgb(6)));
    scene.emitters = {
        PointEmitter{{1, 2, 2}, Rgb(3, 2, 4)},
        SpotEmitter{{-1, 2, 2}, glm::normalize(glm::dvec3(0.3, -1, -0.8)), 0.5, 0.3, Rgb(9)},
        DirectionalEmitter{glm::normalize(glm::dvec3(0.2, -1, -0.5)), Rgb(0.5)},
        ConstantEmitter{Rgb(0.2, 0.3, 0.4)},
        ProjectorEmitter{{0.5, 2, 2}, {0, -0.8, -0.6}, {{-1, 0, 0}, {0, -0.9, 1.2}, {}}, Rgb(1)}};
    scene.camera.to_world = glm::dmat4(glm::dvec4(-1, 0, 0, 0), glm::dvec4(0, 1, 0, 0),
                                       glm::dvec4(0, 0, -1, 0), glm::dvec4(0.1, 0.3, 4.5, 1));
    scene.camera.fov_degrees = 50;
    scene.camera.aperture_radius = 0.05, scene.camera.focus_distance = 4.3;
    scene.film.width = scene.film.crop_width = 40;
    scene.film.height = scene.film.crop_height = 30;
    scene.film.pixel_format = PixelFormat::rgba;
    scene.film.filter.kind = FilterKind::gaussian;
    scene.integrator.rr_depth = 3;
    scene.integrator.second_moment = true;
    scene.integrator.aovs = {{"nn", "sh_normal", {}},
                             {"dd", "depth", {}},
                             {"uv", "uv", {}},
                             {"variance", "variance", {}},
                             {"samples", "samples", {}}};
    scene.sampler.samples_per_pixel = 18;
    scene.sampler.seed = 5;
    return scene;
}

} // namespace parhelion::numerics
