// All that can be turned off and on: for each feature of the kernels what does so, made from the
// list of features, and the integrators, AOVs and options of the command line.
#pragma once

#include "host/render/device_render.h"
#include "tests/support/example_sky.h"
#include "tests/support/example_textures.h"
#include "tests/support/two_of_every.h"

#include <functional>
#include <string>
#include <vector>

namespace parhelion::test {

struct Setup {
    Scene scene;
    RenderOptions options;
};

template<class Change>
void change_meshes(Scene& scene, Change change) {
    for (Shape& shape : scene.shapes)
        if (auto* mesh = std::get_if<Mesh>(&shape.geometry)) change(*mesh);
}
template<class Change>
void change_rough(Scene& scene, Change change) {
    for (Material& m : scene.materials)
        std::visit(
            [&](auto& b) {
                if constexpr (requires { b.roughness.distribution; }) change(b.roughness);
            },
            m.bsdf);
}
/// All lights but those that `stays` says of have no power; what shines stays a surface.
template<class Stays>
void leave_lights(Scene& scene, Stays stays) {
    for (Shape& shape : scene.shapes)
        if (shape.radiance && !stays(*shape.radiance))
            shape.radiance = Rgb(0), shape.radiance_texture = {};
    std::erase_if(scene.emitters, [&](Emitter& e) { return !stays(strength_of(e)); });
}
inline void leave_light(Scene& scene, const Light& light) {
    leave_lights(scene, [&](const Rgb& power) {
        return power.r == light.power.r && power.g == light.power.g && power.b == light.power.b;
    });
}

inline void set_ray_streams(Setup& s, bool on) { s.options.all_features = on; }
inline void set_vertex_normals(Setup& s, bool on) {
    if (!on) change_meshes(s.scene, [](Mesh& m) { m.normals.clear(); });
}
inline void set_consistent_normals(Setup& s, bool on) {
    s.scene.integrator.shading_normals = on ? ShadingNormals::consistent : ShadingNormals::raw;
}
inline void set_soft_terminator(Setup& s, bool on) {
    s.scene.integrator.shading_normals = on ? ShadingNormals::soft : ShadingNormals::consistent;
}
inline void set_vertex_uvs(Setup& s, bool on) {
    if (!on) change_meshes(s.scene, [](Mesh& m) { m.uvs.clear(); });
}
/// Of all that have such a parameter but what is black: lamps.
template<class Change>
void change_materials(Setup& s, Change change) {
    for (std::size_t i = 0; i < s.scene.materials.size(); i++)
        if (i != black_material)
            std::visit([&](auto& b) { change(b, i); }, s.scene.materials[i].bsdf);
}
inline void set_reflectances(Setup& s, const Textured<Rgb>& color) {
    change_materials(s, [&](auto& b, std::size_t) {
        if constexpr (requires { b.reflectance; }) b.reflectance = color;
        if constexpr (requires { b.specular_reflectance; }) b.specular_reflectance = color;
        if constexpr (requires { b.base_color; }) b.base_color = color;
    });
}
/// Textures in turn.
inline void set_textures(Setup& s, bool on) {
    change_materials(s, [&](auto& b, std::size_t i) {
        if constexpr (requires { b.reflectance; })
            if (on) b.reflectance = example_textures[i % example_textures.size()]();
    });
}
inline void set_textured_reflectance(Setup& s, bool on) {
    if (on) set_reflectances(s, example_checkerboard());
}
inline void set_textured_transmittance(Setup& s, bool on) {
    change_materials(s, [&](auto& b, std::size_t) {
        if constexpr (requires { b.specular_transmittance; })
            if (on) b.specular_transmittance = example_checkerboard();
    });
}
inline void set_textured_index(Setup& s, bool on) {
    change_materials(s, [&](auto& b, std::size_t i) {
        if constexpr (requires { b.index; })
            if (on) (i % 2 ? b.index.eta : b.index.k) = example_checkerboard();
    });
}
inline void set_textured_roughness(Setup& s, bool on) {
    if (!on) return;
    change_rough(s.scene, [](auto& r) {
        if constexpr (requires { r.alpha_u; })
            r.alpha_u = r.alpha_v = as_number(example_checkerboard());
    });
    change_materials(s, [](auto& b, std::size_t) {
        if constexpr (requires { b.base_color; }) b.roughness = as_number(example_checkerboard());
    });
}
/// Of Burley's materials, which have so many.
template<class Change>
void change_principled(Setup& s, Change change) {
    change_materials(s, [&](auto& b, std::size_t) {
        if constexpr (requires { b.base_color; }) change(b);
    });
}
inline void set_textured_numbers(Setup& s, bool on) {
    if (!on) return;
    change_principled(s, [](auto& b) {
        b.sheen_tint = b.flatness = as_number(example_checkerboard());
        if constexpr (requires { b.metallic; }) b.metallic = as_number(example_bitmap());
        if constexpr (requires { b.eta.texture; }) b.eta = as_number(example_checkerboard());
    });
}
inline void set_clearcoat(Setup& s, bool on) {
    change_principled(s, [&](auto& b) {
        if constexpr (requires { b.clearcoat; })
            if (!on) b.clearcoat = 0.0;
    });
}
/// Off: none lets light through.
inline void set_spec_trans(Setup& s, bool on) {
    if (!on) change_principled(s, [](auto& b) { b.spec_trans = 0.0; });
}
inline void set_sheen(Setup& s, bool on) {
    if (!on) change_principled(s, [](auto& b) { b.sheen = 0.0; });
}
inline void set_texels_byte(Setup& s, bool on) {
    if (on) set_reflectances(s, textured(example_texels(TexelComponent::byte)));
}
inline void set_texels_half(Setup& s, bool on) {
    if (on) set_reflectances(s, textured(example_texels(TexelComponent::half)));
}
inline void set_texels_single(Setup& s, bool on) {
    if (on) set_reflectances(s, textured(example_texels(TexelComponent::single)));
}
inline void set_back_materials(Setup& s, bool on) {
    for (Shape& shape : s.scene.shapes) {
        int front = shape.material_front;
        bool blend = IS_BLEND(front) && front == shape.material_back; // of opaque ones
        bool opaque = front >= 0 && front <= black_material &&
                      parhelion::is_opaque(s.scene.materials[static_cast<std::size_t>(front)].bsdf);
        if (!on && (blend || opaque)) shape.material_back = no_material;
    }
}
/// On: opaque ones are blends with the first material, null ones masks of it.
inline void set_blends(Setup& s, bool on) {
    if (!on) return;
    for (Shape& shape : s.scene.shapes) {
        int front = shape.material_front, back = shape.material_back;
        if (front < 0 || front == black_material) continue;
        auto kind = static_cast<std::size_t>(front) / 2;
        if (is_opaque(kind)) {
            shape.material_front = add_blend(s.scene, {0.4, front, 0});
            shape.material_back = back == no_material ? no_material : shape.material_front;
        } else if (kind == material_null) {
            shape.material_front = add_blend(s.scene, {0.4, front, 0});
            shape.material_back = add_blend(s.scene, {0.4, back, no_material});
        }
    }
}
/// On: what is black beside is told by a texture.
inline void set_textured_blends(Setup& s, bool on) {
    if (!on) return;
    for (Shape& shape : s.scene.shapes) {
        int front = shape.material_front;
        if (front < 0 || front == black_material) continue;
        auto weight = as_number(example_checkerboard());
        shape.material_front = add_blend(s.scene, {weight, front, 0});
        if (is_opaque(static_cast<std::size_t>(front) / 2)) continue;
        shape.material_back = add_blend(s.scene, {weight, shape.material_back, no_material});
    }
}
inline void set_textured_lights(Setup& s, bool on) {
    for (Shape& shape : s.scene.shapes) {
        if (!on || !shape.radiance) continue;
        const Rgb radiance = *shape.radiance; // all over the board, so that what shows is known
        shape.radiance_texture =
            textured(Texture{"", glm::dmat3(1), CheckerboardTexture{radiance, radiance}}).texture;
    }
}
/// On: a board before every light that can have one.
inline void set_projected_textures(Setup& s, bool on) {
    if (!on) return;
    const TextureUse board = example_checkerboard().texture;
    for (Emitter& emitter : s.scene.emitters) {
        if (auto* projector = std::get_if<ProjectorEmitter>(&emitter))
            projector->slide.texture = board;
        if (auto* spot = std::get_if<SpotEmitter>(&emitter)) {
            const glm::dvec3& n = spot->direction;
            const glm::dvec3 across = glm::normalize(glm::cross(n, {0, 0, 1}));
            const double scale = 0.5 / std::tan(spot->cutoff_angle);
            spot->slide = {scale * across, scale * glm::cross(n, across), board};
        }
    }
}
inline void set_ggx(Setup& s, bool on) {
    if (on) return;
    for (Material& m : s.scene.materials)
        if (std::visit(
                [](const auto& b) {
                    return requires { b.roughness.distribution; };
                },
                m.bsdf))
            m.bsdf = DiffuseBsdf{Rgb(0.4)};
}
inline void set_beckmann(Setup& s, bool on) {
    if (!on) change_rough(s.scene, [](auto& r) { r.distribution = MicrofacetDistribution::ggx; });
}
inline void set_anisotropy(Setup& s, bool on) {
    if (on) return;
    change_materials(s, [](auto& b, std::size_t) {
        if constexpr (requires { b.roughness.alpha_v; }) b.roughness.alpha_v = b.roughness.alpha_u;
        if constexpr (requires { b.anisotropic; }) b.anisotropic = 0.0;
    });
}
inline void set_tilts(Setup& s, bool of_normals) {
    for (std::size_t i = 0; i < s.scene.materials.size(); i++)
        if (i != black_material) {
            Tilt tilt;
            tilt.texture = textured(example_texels(TexelComponent::byte)).texture;
            tilt.of_normals = of_normals;
            tilt.scale = of_normals ? 1.0 : 0.05;
            s.scene.materials[i].tilt = tilt;
        }
}
inline void set_normal_maps(Setup& s, bool on) {
    if (on) set_tilts(s, true);
}
inline void set_bump_maps(Setup& s, bool on) {
    if (on) set_tilts(s, false);
}
inline void set_tangents(Setup& s, bool on) { set_anisotropy(s, on); }
inline void set_energy_compensation(Setup& s, bool on) { set_energy_compensation(s.scene, on); }
inline void set_faure(Setup& s, bool on) {
    s.scene.sampler.pattern = on ? SamplePattern::faure : SamplePattern::independent;
}
inline void set_replicates(Setup& s, bool on) { s.scene.sampler.replicates = on ? 4 : 1; }
inline void set_thin_lens(Setup& s, bool on) {
    s.scene.camera.aperture_radius = on ? 0.02 : 0;
    s.scene.camera.focus_distance = view_distance(s.scene);
}
/// On: a film that is as wide as what is seen there.
inline void set_orthographic(Setup& s, bool on) {
    if (!on) return;
    Camera& camera = s.scene.camera;
    double half = view_distance(s.scene) * std::tan(*camera.fov_degrees * std::numbers::pi / 360);
    camera.orthographic = true;
    for (int axis : {0, 1})
        camera.to_world[axis] = half * glm::normalize(camera.to_world[axis]);
}
inline void move(Geometry& geometry, const glm::dvec3& by) {
    if (auto* mesh = std::get_if<Mesh>(&geometry))
        for (glm::dvec3& p : mesh->positions)
            p += by;
    if (auto* sphere = std::get_if<Sphere>(&geometry)) sphere->center += by;
    if (auto* disk = std::get_if<Disk>(&geometry)) disk->center += by;
    if (auto* cylinder = std::get_if<Cylinder>(&geometry)) cylinder->base += by;
}
/// On: as much to be seen, from much farther away.
inline void set_far_camera(Setup& s, bool on) {
    if (!on) return;
    Camera& camera = s.scene.camera;
    if (camera.to_world[2].z > 0) // objects are out of the way of the panel
        for (std::size_t i = 0; i < object_count; i++)
            move(s.scene.shapes[i].geometry, {0, 60, 0});
    double near = view_distance(s.scene), far = 1e5;
    camera.to_world[3] -= (far - near) * camera.to_world[2];
    double half = std::tan(*camera.fov_degrees * std::numbers::pi / 360) * near / far;
    camera.fov_degrees = 360 / std::numbers::pi * std::atan(half);
    camera.far_clip = 2 * far;
    camera.focus_distance = far;
}
inline void set_filter(Setup& s, bool on, FilterMethod method) {
    s.scene.film.filter.kind = on ? FilterKind::gaussian : FilterKind::box;
    s.scene.film.filter_method = method;
}
inline void set_filter_splatting(Setup& s, bool on) { set_filter(s, on, FilterMethod::splatting); }
inline void set_filter_sampling(Setup& s, bool on) { set_filter(s, on, FilterMethod::sampling); }
inline void set_several_lights(Setup& s, bool on) {
    if (!on) leave_light(s.scene, example_lights()[3]);
}
inline void set_light_tree(Setup& s, bool on) {
    if (!on) leave_light(s.scene, example_lights()[5]);
}
inline void set_next_event(Setup& s, bool on) { s.scene.integrator.emitter_samples = on; }
/// Without: what shines is nowhere to be met.
inline void set_emission(Setup& s, bool on) {
    if (!on) leave_light(s.scene, example_lights()[2 * emitter_spot]);
}
/// Of the sunsky in the sky's place, if there is one or is to be.
inline void set_daylight_sky(Setup& s, bool on) {
    if (on) put_example_daylight(s.scene).sky_scale = 3;
}
inline void set_daylight_sun(Setup& s, bool on) {
    if (on) put_example_daylight(s.scene).sun_scale = 0.1;
}
inline void set_scattering(Setup& s, bool on) {
    s.scene.integrator.kind = on ? IntegratorKind::path : IntegratorKind::direct;
    s.scene.integrator.bsdf_samples = on;
}
inline void set_straight_through(Setup& s, bool on) {
    if (on) return;
    for (Material& m : s.scene.materials)
        if ((PASSING_MATERIALS >> m.bsdf.index()) & 1) m.bsdf = DiffuseBsdf{Rgb(0.4)};
}
inline void set_clear_shadows(Setup& s, bool on) {
    for (Material& m : s.scene.materials)
        if (!on && std::holds_alternative<NullBsdf>(m.bsdf)) m.bsdf = DiffuseBsdf{Rgb(0.4)};
}
inline void set_hide_emitters(Setup& s, bool on) { s.scene.integrator.hide_emitters = on; }
inline void set_russian_roulette(Setup& s, bool on) { s.scene.integrator.rr_depth = on ? 1 : 9; }
inline void set_view_normals(Setup& s, bool on) {
    if (on) s.scene.integrator.kind = IntegratorKind::normals;
}
inline void set_view_depth(Setup& s, bool on) {
    if (on) s.scene.integrator.kind = IntegratorKind::depth;
}
inline void set_moments(Setup& s, bool on) { s.scene.integrator.second_moment = on; }
inline void ask_aov(Setup& s, const char* kind) {
    auto& aovs = s.scene.integrator.aovs;
    auto same = [&](const AovRequest& a) { return a.kind == kind; };
    if (std::none_of(aovs.begin(), aovs.end(), same)) aovs.push_back({kind, kind, {}});
}
inline void set_analytic_uvs(Setup& s, bool on) {
    if (on) ask_aov(s, "uv");
}
inline void set_variance(Setup& s, bool on) {
    if (on) ask_aov(s, "variance");
}
inline void set_shape_ids(Setup& s, bool on) { s.scene.integrator.cryptomatte.objects = on; }
/// One of all that shines from surfaces by an id, and what does not.
inline void set_light_groups(Setup& s, bool on) {
    if (!on) return;
    for (Shape& shape : s.scene.shapes)
        if (shape.radiance) shape.emitter_id = "lamps";
    s.scene.integrator.light_groups = {{"lamps", {"lamps"}}, {"rest", {}}};
}
inline void set_aovs(Setup& s, bool on) {
    if (on) ask_aov(s, "albedo");
}

struct Switch {
    const char* name;
    Feature feature;
    void (*set)(Setup&, bool on);
};
#define FEATURE_SWITCH(name) Switch{#name, feature_##name, set_##name},
inline constexpr std::array feature_switches{OTHER_FEATURES(FEATURE_SWITCH)};

struct State {
    std::string name;
    std::function<void(Setup&)> set;
    std::string of; ///< two states of one thing exclude each other
};

inline State integrator_state(const char* name, IntegratorKind kind, int max_depth,
                              int strategies) {
    return {name,
            [=](Setup& s) {
                Integrator& i = s.scene.integrator;
                i.kind = kind, i.max_depth = max_depth;
                i.emitter_samples = strategies & 1, i.bsdf_samples = strategies & 2;
            },
            "integrator"};
}

/// Both of every feature, and one of everything else.
inline std::vector<State> every_state() {
    std::vector<State> states;
    for (const Switch& s : feature_switches)
        for (bool on : {false, true})
            states.push_back({std::string(s.name) + (on ? " on" : " off"),
                              [&s, on](Setup& setup) { s.set(setup, on); }, s.name});
#define AOV_STATE(name, channels, suffixes)                                                        \
    states.push_back({"aov " #name, [](Setup& s) { ask_aov(s, #name); }, "aov " #name});
    AOVS(AOV_STATE)
    FILM_AOVS(AOV_STATE)
    states.push_back({"a sky of an image", [](Setup& s) { put_example_sky(s.scene); }, "sky"});
    states.push_back(integrator_state("path 1", IntegratorKind::path, 1, 3));
    states.push_back(integrator_state("path 2", IntegratorKind::path, 2, 3));
    states.push_back(integrator_state("path without end", IntegratorKind::path, -1, 3));
    states.push_back(integrator_state("path 1 without next event", IntegratorKind::path, 1, 2));
    states.push_back(integrator_state("direct", IntegratorKind::direct, 2, 3));
    states.push_back(integrator_state("direct, emitters", IntegratorKind::direct, 2, 1));
    states.push_back(integrator_state("direct, BSDFs", IntegratorKind::direct, 2, 2));
    states.push_back(integrator_state("aov alone", IntegratorKind::aov, 1, 3));
    return states;
}

} // namespace parhelion::test
