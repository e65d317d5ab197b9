// What a path sees where it has got to: light of the surface or the sky there, whether its pixel is
// covered, and the views.
#ifndef PARHELION_SHADE_SEE_H
#define PARHELION_SHADE_SEE_H

#include "device/camera_lanes.h"
#include "device/coverage.h"
#include "device/daylight.h"
#include "device/environment.h"
#include "device/light_table.h"
#include "device/light_texture.h"
#include "device/notes.h"
#include "device/shade_work.h"

/// Where light that the path sees could have been sampled from.
FN vec3 lit_from(Path path) {
    if (HAS(clear_shadows)) return path.scattered_at;
    return path.origin;
}

/// With the probability of its pick where the path could have sampled it.
FN Light light_pickable(ShadeWork w, Path path, Light light, Int row, Mask lanes) {
    Real pmf = light_pmf(w.scene.light_nodes, w.scene.light_leaves, lit_from(path), row, lanes);
    return light_picked_with(light, pmf);
}

/// Radiance of the sky for lanes that missed everything, weighted against next event estimation;
/// nothing for the hidden ones.
FN vec3 sky_emission(ShadeWork w, Path path, Mask missed, Mask hidden) {
    Light light = load_Light(w.scene.lights, (Int)w.params->sky_light);
    if (HAS(next_event))
        light =
            light_pickable(w, path, light, (Int)w.params->sky_light, missed & finiteR(path.pdf));
    SkySeen sky;
    if (HAS(emitter_envmap)) {
        sky = sky_seen(w.scene, light, w.params->sky_texture, path.direction, missed);
    } else if (HAS(emitter_sunsky)) {
        sky = daylight_seen(w.scene, light, w.params->sky_texture, path.direction, missed);
    } else {
        sky.radiance = light_radiance(light);
        sky.pdf = emitter_constant_pdf(light, path.origin, path.direction, path.origin);
    }
    NOTE(sky, sky.radiance);
    Real weight = R(1.);
    if (HAS(next_event)) {
        NOTE(sky_pdf, sky.pdf);
        weight = power_heuristic(path.pdf, sky.pdf);
        NOTE(emission_weight, weight);
    }
    if (HAS(hide_emitters)) weight = sel(hidden, R(0.), weight);
    return scale3(sky.radiance, weight);
}

/// Radiance of the emitters the lanes hit, weighted against next event estimation.
FN vec3 surface_emission(ShadeWork w, PathVertex v) {
    Mask emits = v.hit & (v.primitive.stored.light >= 0);
    vec3 emitted = splat3(R(0.));
    if (!someLane(emits)) return emitted;
    Int row = (Int)0;
    if (HAS(several_lights)) row = sel(emits, v.primitive.stored.light, row);
    Light light = load_Light(w.scene.lights, row);
    // Next event estimation has no part in what the camera or a mirror sees.
    Mask weighted = emits & finiteR(v.path.pdf);
    if (HAS(next_event))
        light = light_pickable(w, v.path, light, row, weighted);
    else
        weighted = emits & !emits;
    EmitterHit e = emitter_hit(light, lit_from(v.path), v.path.direction, v.surface.p, weighted);
    if (HAS(textured_lights))
        e.radiance = mul3(e.radiance, light_color(w.scene, row, texture_place(v), emits));
    NOTE(emission, e);
    emitted = sel3(emits, e.radiance, emitted);
    if (someLane(weighted)) {
        Real weight = power_heuristic(v.path.pdf, e.pdf);
        NOTE(emission_weight, weight);
        emitted = scale3(emitted, sel(weighted, weight, R(1.)));
    }
    return emitted;
}

/// Lanes that must not see the sky: hide_emitters keeps it from the camera.
FN Mask sky_hidden(ShadeWork w, PathVertex v) {
    if (HAS(hide_emitters) && HAS(straight_through)) return uncovered(w.results, v);
    if (w.depth == 0) return v.active;
    return v.active & !v.active;
}

/// A view of geometry in place of light.
FN vec3 view_of(ShadeWork w, PathVertex v) {
    vec3 seen = splat3(R(0.));
    if (HAS(view_normals)) seen = scale3(add3(v.surface.ns, splat3(R(1.))), R(.5));
    if (HAS(view_depth))
        seen = splat3(camera_distance(camera_lanes(w.params->camera), v.path.origin, v.path.t));
    return sel3(v.hit, seen, splat3(R(0.)));
}

FN vec3 seen_light(ShadeWork w, PathVertex v) {
    vec3 seen = splat3(R(0.));
    if (HAS(view_normals) || HAS(view_depth)) seen = view_of(w, v);
    if (!HAS(emission)) return seen;
    seen = add3(seen, surface_emission(w, v));
    if (HAS_SKY) {
        Mask sky = v.active & !v.hit, hidden = sky_hidden(w, v);
        if (someLane(sky)) seen = sel3(sky, sky_emission(w, v.path, sky, hidden), seen);
    }
    return seen;
}

/// What was gathered from the lights that the lanes see, or the sky, to their groups.
FN void see_groups(ShadeWork w, PathVertex v, vec3 gathered, uint bits) {
    Int row = (Int)w.params->sky_light;
    if (HAS(several_lights)) row = sel(v.hit, v.primitive.stored.light, row);
    if (!HAS(several_lights)) row = (Int)0;
    add_result3_by_lane(w.results, light_group(w.scene.light_groups, row, bits), v.path.slot,
                        gathered, bits);
}

/// The lanes' pixels are covered by what they have hit, or by a sky that counts.
FN void see_coverage(ShadeWork w, PathVertex v, vec3 seen) {
    if (HAS(straight_through)) {
        Mask covered = v.hit & (max_component(seen) != R(0.));
        if (w.params->sky_covers) covered = v.active;
        cover(w.results, v, covered);
    } else if (w.depth == 0) {
        Mask covered = v.hit;
        if (w.params->sky_covers) covered = v.active;
        add_result(w.results, result_alpha, v.path.slot, R(1.), maskBits(covered));
    }
}

/// Writes: results (light, alpha).
FN void see(ShadeWork w, PathVertex v) {
    vec3 seen = seen_light(w, v);
    Mask bad_emission = v.active & !v.active;
    if (HAS(emission) || w.depth == 0) {
        vec3 gathered = mul3(v.path.throughput, seen);
        bad_emission = v.active & (nought3(gathered) != R(0.));
        uint bits = maskBits(v.active & (max_component(seen) != R(0.)));
        if (bits) add_result3(w.results, result_r, v.path.slot, gathered, bits);
        if (HAS(light_groups) && HAS(emission) && bits) see_groups(w, v, gathered, bits);
    }
    see_coverage(w, v, seen);
    mark_bad(w.results, v.path.slot, v.bad_hit, fault_hit, w.depth);
    mark_bad(w.results, v.path.slot, bad_emission, fault_emission, w.depth);
}

#endif
