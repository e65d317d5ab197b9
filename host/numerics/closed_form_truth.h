// The list of scenes/closed_form: what each image must be, and how strictly to test it.
//
// For every setting, render scenes/closed_form/<folder>/scene.xml with `parameters` (as -D) and
// `next_event`, and compare each pixel with truth(x, y), y counted from the top.
#pragma once

#include "host/numerics/closed_form_formulas.h"
#include "host/scene/scene.h"

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <map>
#include <string>
#include <vector>

namespace parhelion::closed_form {

enum class Judgement {
    exact_bits,  ///< every pixel equals the truth, rounded to float, bit for bit
    noise_free,  ///< every pixel within `tolerance`, relative, whatever the seed
    mean_z_test, ///< over independent seeds: the mean within its standard error + tolerance * truth
};

struct Setting {
    std::string name;
    std::string folder;
    std::map<std::string, std::string> parameters; ///< -D name=value
    int spp;                                       ///< samples a pixel for one seed
    Judgement judgement;
    /// Relative, for any one pixel. noise_free: rounding, and the pixel not being a point.
    /// mean_z_test: what the scene's finite extent (a ground that ends, a pixel) takes from the
    /// truth.
    double tolerance;
    std::function<Rgb(int x, int y)> truth;
    bool next_event = true; ///< false: BSDF sampling alone, no light sampling
};

namespace detail {

inline std::function<Rgb(int, int)> everywhere(Rgb value) {
    return [value](int, int) { return value; };
}

inline const Rgb light{1, 2, 4};        ///< radiance, intensity or irradiance of most scenes
inline const Rgb albedo{0.8, 0.5, 0.2}; ///< of most receivers

using Parameters = std::map<std::string, std::string>;

/// A setting whose image is one colour.
inline Setting uniform_setting(const std::string& folder, const Parameters& parameters, int spp,
                               Judgement judgement, double tolerance, Rgb value) {
    std::string name = folder;
    for (const auto& [key, text] : parameters)
        name += " " + key + "=" + text;
    return {name, folder, parameters, spp, judgement, tolerance, everywhere(value)};
}

inline Rgb enclosure(Rgb radiance, Rgb r, int terms) {
    Rgb sum;
    for (int c = 0; c < 3; ++c)
        sum[c] = radiance[c] * geometric_sum(r[c], terms);
    return sum;
}

/// Every wall point sees L from everywhere, so it sends L + r (what arrives): a geometric series
/// in r, one term for each edge of the longest path.
inline void add_enclosures(std::vector<Setting>& settings) {
    const Rgb limit = light / (1.0 - albedo);
    settings.push_back(
        uniform_setting("enclosure_sphere", {}, 256, Judgement::mean_z_test, 0, limit));
    settings.push_back(uniform_setting("enclosure_box", {}, 256, Judgement::mean_z_test, 0, limit));
    settings.push_back(uniform_setting("enclosure_sphere", {{"max_depth", "1"}}, 4,
                                       Judgement::exact_bits, 0, light));
    for (int depth : {2, 3, 6}) {
        settings.push_back(
            uniform_setting("enclosure_sphere", {{"max_depth", std::to_string(depth)}}, 256,
                            Judgement::mean_z_test, 0, enclosure(light, albedo, depth)));
    }
    const Rgb half = enclosure(Rgb{1}, Rgb{0.5}, 12);
    settings.push_back(uniform_setting("enclosure_half", {}, 64, Judgement::mean_z_test, 0, half));
    settings.push_back(uniform_setting("enclosure_half", {}, 64, Judgement::exact_bits, 0, half));
    settings.back().name += " by BSDF sampling alone";
    settings.back().next_event = false;
}

/// The centre lights every wall point alike (cos = 1): E = I/R^2, then the enclosure's series;
/// the first edge carries nothing because the wall does not emit.
inline void add_point_light_in_sphere(std::vector<Setting>& settings) {
    const Rgb first = albedo * Rgb{4, 8, 16} / (pi * 4);
    const std::string folder = "point_light_in_sphere";
    // Its blue ends early, almost without noise: what is left is rounding, 1.2e-6.
    settings.push_back(
        uniform_setting(folder, {}, 256, Judgement::mean_z_test, 2e-6, first / (1.0 - albedo)));
    for (int depth : {2, 8}) {
        const Parameters parameters{{"max_depth", std::to_string(depth)}, {"rr_depth", "100"}};
        settings.push_back(uniform_setting(folder, parameters, 16, Judgement::noise_free, 5e-6,
                                           enclosure(first, albedo, depth - 1)));
    }
}

/// E = I f(angle) cos^3/h^2 on a plane at distance h below the light, and L = r E/pi.
inline void add_small_lights(std::vector<Setting>& settings) {
    const Rgb below = albedo * light / pi; // at h = 1 and normal incidence
    settings.push_back({"point_light_over_plane",
                        "point_light_over_plane",
                        {},
                        256,
                        Judgement::mean_z_test,
                        0,
                        [below](int x, int y) {
                            return below *
                                   mean_inverse_square_cosine(pixel_footprint(x, y, 16, 2), 1);
                        }});
    for (const char* d : {"0", "1", "3"}) { // a needle: the pixel is a point to within 1e-5
        const Parameters parameters{{"fov", "0.0001"}, {"center_x", d}};
        settings.push_back(
            uniform_setting("point_light_over_plane", parameters, 16, Judgement::noise_free, 2e-5,
                            below * std::pow(1 + std::stod(d) * std::stod(d), -1.5)));
    }
    settings.push_back(
        uniform_setting("directional_light", {}, 4, Judgement::noise_free, 2e-6, below * 0.8));
    for (double degrees : {10.0, 30.0, 35.0, 45.0}) {
        const double angle = glm::radians(degrees);
        const double falloff = std::clamp((40 - degrees) / (40 - 20), 0.0, 1.0);
        settings.push_back(
            uniform_setting("spot_light", {{"center_x", std::to_string(std::tan(angle))}}, 16,
                            falloff > 0 ? Judgement::noise_free : Judgement::exact_bits, 5e-5,
                            below * falloff * std::pow(std::cos(angle), 3)));
    }
}

/// Irradiance at a point from an area light, L = r L_light F, by each strategy and both together.
inline void add_area_lights(std::vector<Setting>& settings) {
    const std::vector<glm::dvec3> triangle{{1, -0.5, 1}, {0.2, 1, 1.5}, {1.5, 0.8, 0.6}};
    const std::vector<std::pair<std::string, Rgb>> lights{
        // F = R^2/(R^2 + h^2)
        {"disk_light", albedo * light * (2.25 / 3.25)},
        // F = (R/d)^2 cos, the whole sphere above the horizon
        {"sphere_light", albedo * light * 10.0 * (0.25 / 4) * 0.8},
        {"rectangle_light", albedo * light * corner_form_factor(1.5, 2, 1)},
        {"polygon_light", albedo * light * 10.0 * polygon_form_factor(triangle)},
    };
    for (const auto& [folder, value] : lights) {
        for (const Parameters& strategy : {Parameters{}, Parameters{{"bsdf_samples", "0"}},
                                           Parameters{{"emitter_samples", "0"}}})
            settings.push_back(
                uniform_setting(folder, strategy, 1024, Judgement::mean_z_test, 5e-5, value));
    }
    // F = 1/d^2 cos, cos = 1/d from the centre. Rounding counts for more the narrower the gap is.
    for (const Parameters& parameters :
         {Parameters{{"distance", "0.02"}, {"bsdf_samples", "0"}}, Parameters{{"distance", "0.02"}},
          Parameters{{"distance", "0.005"}}}) {
        const double d = std::hypot(1, std::stod(parameters.at("distance")));
        settings.push_back(uniform_setting("touching_sphere_light", parameters, 1024,
                                           Judgement::mean_z_test, 1e-4,
                                           albedo * light / (d * d * d)));
    }
}

/// Pixel by pixel form factors of the floor of a unit cube; their mean is 0.199824895698387 to the
/// opposite face and 0.200043776075403 to an adjacent one.
inline void add_unit_cubes(std::vector<Setting>& settings) {
    const Rgb full = albedo * light;
    settings.push_back({"unit_cube_parallel",
                        "unit_cube_parallel",
                        {},
                        1024,
                        Judgement::mean_z_test,
                        0,
                        [full](int x, int y) {
                            return full * parallel_form_factor(pixel_footprint(x, y, 8, 0.5),
                                                               {-0.5, 0.5, -0.5, 0.5}, 1);
                        }});
    // All of the floor, and a strip of it next to the emitter, which is seen there under pi sr.
    for (double half_width : {0.5, 5e-4}) {
        const Parameters parameters{
            {"fov", fmt::format("{}", 2 * glm::degrees(std::atan(half_width / 0.5)))},
            {"center_x", fmt::format("{}", 0.5 - half_width)}};
        settings.push_back({fmt::format("unit_cube_perpendicular, {} wide", 2 * half_width),
                            "unit_cube_perpendicular", parameters, 1024, Judgement::mean_z_test,
                            half_width < 0.5 ? 5e-5 : 0, [=](int x, int y) {
                                Footprint f = pixel_footprint(x, y, 8, half_width);
                                f.x0 += 0.5 - half_width, f.x1 += 0.5 - half_width;
                                return full * perpendicular_form_factor(f, 0.5, -0.5, 0.5, 1);
                            }});
    }
}

/// A uniform sky gives E = pi L times the visible part of the projected hemisphere.
inline void add_skies(std::vector<Setting>& settings) {
    for (int tilt : {0, 60, 90, 120}) { // plate above black ground: (1 + cos tilt)/2 is sky
        const double visible = (1 + std::cos(glm::radians(double(tilt)))) / 2;
        settings.push_back(uniform_setting("half_blocked_sky",
                                           {{"pitch", std::to_string(tilt - 90)}}, 1024,
                                           Judgement::mean_z_test, 2e-5, albedo * light * visible));
    }
    settings.push_back(uniform_setting("sphere_blocked_sky", {}, 1024, Judgement::mean_z_test, 5e-5,
                                       albedo * light * (1 - 0.36 * 0.8)));
}

/// Light through a slab of reflectance R = ((n-1)/(n+1))^2 a face: the series of inner reflections
/// T = s^2 (1-R)^2/(1 - q^2 R^2), reflected q R (1 + T), with tints s (transmission), q
/// (reflection).
inline void add_glass(std::vector<Setting>& settings) {
    const double face = 0.04, through = 2 * 1.5 / (1.5 * 1.5 + 1);
    for (const char* folder : {"clear_slab", "thin_slab"}) {
        settings.push_back(
            uniform_setting(folder, {}, 1024, Judgement::mean_z_test, 1e-6, Rgb{through}));
        settings.push_back(uniform_setting(folder, {{"light_z", "-5"}}, 1024,
                                           Judgement::mean_z_test, 1e-6, Rgb{1 - through}));
    }
    const Rgb s{1, 0.9, 0.5}, q{0.5, 1, 0.8};
    const Rgb tinted = s * s * ((1 - face) * (1 - face)) / (1.0 - q * q * (face * face));
    const Parameters tint{{"transmittance", "1, 0.9, 0.5"}, {"reflectance", "0.5, 1, 0.8"}};
    Parameters mirrored = tint;
    mirrored["light_z"] = "-5";
    settings.push_back(
        uniform_setting("clear_slab", tint, 1024, Judgement::mean_z_test, 1e-6, tinted));
    settings.push_back(uniform_setting("clear_slab", mirrored, 1024, Judgement::mean_z_test, 1e-6,
                                       q * face * (1.0 + tinted)));
    // In: (1 - Fo) pi, between wall and glass a series in r Fi, out at the normal: (1 - R0)/n^2;
    // and (1 - Fo)/n^2 = 1 - Fi.
    const double inside = hemispherical_fresnel_inside(1.5);
    const Rgb wall{0.9, 0.5, 0.2};
    settings.push_back(
        uniform_setting("hemispherical_fresnel", {}, 1024, Judgement::mean_z_test, 1e-5,
                        face + (1 - face) * wall * (1 - inside) / (1.0 - wall * inside)));
    settings.push_back(uniform_setting("glass_sphere_in_uniform_sky", {}, 64, Judgement::noise_free,
                                       5e-6, Rgb{1}));
}

/// What receives as much light from everywhere and loses none of it cannot be seen, rough or not.
/// Tables of energy compensation are good for 0.3 % a vertex, and much better at most angles.
inline void add_rough_spheres(std::vector<Setting>& settings) {
    for (const char* bsdf : {"metal", "brushed_metal", "glass"})
        for (const char* distribution : {"ggx", "beckmann"}) {
            const Parameters parameters{{"bsdf", bsdf}, {"distribution", distribution}};
            settings.push_back(uniform_setting("rough_sphere_in_uniform_sky", parameters, 256,
                                               Judgement::mean_z_test, 1e-3, Rgb{1}));
        }
}

inline void add_mirrors(std::vector<Setting>& settings) {
    settings.push_back(uniform_setting("facing_mirrors", {}, 4, Judgement::noise_free, 4e-6,
                                       glm::pow(Rgb{0.9, 0.8, 0.5}, Rgb{8})));
    for (int degrees : {0, 45, 75, 85}) {
        const double c = std::cos(glm::radians(double(degrees)));
        const Rgb reflected{conductor_reflectance(c, 0.2, 3.5), conductor_reflectance(c, 0.9, 2.5),
                            conductor_reflectance(c, 1.5, 1.9)};
        settings.push_back(uniform_setting("conductor_reflectance",
                                           {{"angle", std::to_string(degrees)}}, 4,
                                           Judgement::noise_free, 2e-5, reflected));
    }
    settings.push_back(
        uniform_setting("null_layers", {}, 16, Judgement::exact_bits, 0, Rgb{1, 0.5, 0.25}));
}

/// Emitters seen directly: what counts is which part of the pixel, or of the lens, sees them.
inline void add_coverage(std::vector<Setting>& settings) {
    settings.push_back({"half_plane_edge",
                        "half_plane_edge",
                        {},
                        256,
                        Judgement::mean_z_test,
                        0,
                        [](int x, int y) {
                            const double tilt = glm::radians(30.0);
                            return light * half_plane_coverage(pixel_footprint(x, y, 16, 1),
                                                               {0.13, -0.07},
                                                               {std::cos(tilt), std::sin(tilt)});
                        }});
    for (double focus : {1.0, 2.0, 8.0}) { // blur circle of radius 0.5 |1 - 4/focus| at z = 4
        const double t = 0.2 / (0.5 * std::abs(1 - 4 / focus));
        settings.push_back(
            uniform_setting("thinlens_edge", {{"focus_distance", std::to_string(focus)}}, 1024,
                            Judgement::mean_z_test, 5e-5, light * disk_beyond_line(t)));
    }
}

} // namespace detail

/// Every setting of a closed-form scene, in the order of scenes/README.md.
inline std::vector<Setting> settings() {
    std::vector<Setting> all;
    detail::add_enclosures(all);
    detail::add_point_light_in_sphere(all);
    detail::add_small_lights(all);
    detail::add_area_lights(all);
    detail::add_unit_cubes(all);
    detail::add_skies(all);
    detail::add_glass(all);
    detail::add_rough_spheres(all);
    detail::add_mirrors(all);
    detail::add_coverage(all);
    return all;
}

} // namespace parhelion::closed_form
