// Next event estimation: one shadow ray a vertex with its finished contribution.
#ifndef PARHELION_SHADE_LIGHT_H
#define PARHELION_SHADE_LIGHT_H

#include "device/daylight.h"
#include "device/environment.h"
#include "device/light_table.h"
#include "device/light_texture.h"
#include "device/shade_lobes.h"

typedef struct {
    Mask lanes; // that get light from their sample
    EmitterSample sample;
    vec3 contribution;
    Int row; // of its light
} DirectLight;

/// Against a ray of the BSDF's choice that meets the light, which does not know how this surface
/// lies.
FN Real light_weight(EmitterSample e, LightPick pick, Mask reached, Real bsdf_pdf) {
    Real inverse_hint = e.inverse_pdf;
    if (HAS(light_tree))
        inverse_hint = e.inverse_pdf * (pick.pmf / sel(reached, pick.pmf_hint, R(1.)));
    return power_heuristic_inverse(inverse_hint, bsdf_pdf);
}

/// Writes: results (what went wrong).
FN DirectLight direct_light(ShadeWork w, PathVertex v, Shading s) {
    Random4 r = sampler_draw(s.number, bounce_set(w.depth, draw_emitter));
    NOTE(emitter_draw, r);
    // Seen from where rays to this side begin, as by a ray of the BSDF's choice that meets the
    // light: next to an emitter even the clearance changes its solid angle.
    vec3 from = leave_surface(v.surface.p, s.clearance, v.surface.ng, neg3(v.path.direction));
    LightPick pick = pick_light(w.scene.light_nodes, from, s.sides.n, s.lanes, r.x, r.y);
    NOTE(pick, pick);
    Mask reached = s.lanes & !(pick.pmf <= R(0.));
    Light light =
        light_picked_with(load_Light(w.scene.lights, pick.row), sel(reached, pick.pmf, R(1.)));
    DirectLight d;
    d.row = pick.row;
    d.sample = emitter_sample(light, from, uniform2(r.z, r.w));
    if (HAS(emitter_envmap)) {
        Mask sky = reached & (light.kind == emitter_envmap);
        if (someLane(sky))
            d.sample = sel_emitter(sky, sky_chosen(w.scene, light, w.params->sky_texture, r, sky),
                                   d.sample);
    }
    if (HAS(emitter_sunsky)) {
        Mask sky = reached & (light.kind == emitter_sunsky);
        if (someLane(sky))
            d.sample = sel_emitter(
                sky, daylight_chosen(w.scene, light, w.params->sky_texture, r, sky), d.sample);
    }
    if (HAS(textured_lights))
        d.sample.weight = mul3(d.sample.weight,
                               sampled_light_color(w.scene, v.path, pick.row, d.sample.q, reached));
    if (HAS(projected_textures)) {
        vec3 color = projected_color(w.scene, light, pick.row, d.sample, reached);
        d.sample.weight = mul3(d.sample.weight, color);
    }
    NOTE(light, d.sample);
    vec3 wi = to_local(s.frame, d.sample.wi);
    wi.z = wi.z * s.side;
    BsdfEval f = eval_material(w.scene, s.seen, wi, s.lanes);
    if (HAS(blends)) {
        f.f = mul3(f.f, lobe_scale(w, s, s.seen, d.sample.wi, s.lanes));
        f = eval_all_lobes(w, s, f, d.sample.wi, s.lanes);
    }
    NOTE(towards_light, f);
    Real weight = R(1.);
    if (HAS(emission) && HAS(scattering)) {
        weight = light_weight(d.sample, pick, reached, f.pdf);
        NOTE(light_weight, weight);
    }
    if (!HAS(blends) && HAS(consistent_normals)) {
        Real share = counted_share(s.sides, s.material, d.sample.wi);
        NOTE(light_share, share);
        weight = weight * share;
    }
    d.contribution = scale3(mul3(mul3(s.throughput, f.f), d.sample.weight), weight);
    Mask bad = reached & (nought3(d.contribution) != R(0.));
    mark_bad(w.results, v.path.slot, bad, fault_next_event, w.depth);
    vec3 brought = d.contribution;
    if (HAS(emitter_sunsky)) brought = abs3(brought); // colours of daylight may be less than 0
    d.lanes = reached & (max_component(brought) > R(0.)) & !bad;
    return d;
}

/// Pushes a shadow ray of each lane that gets light; how many. Writes: results (what went wrong).
FN int cast_shadow_rays(ShadeWork w, PathVertex v, Shading s, DirectLight d, StatePlace to) {
    if (!maskBits(d.lanes)) return 0;
    EmitterSample e = d.sample;
    ShadowRay ray;
    ray.origin = leave_surface(v.surface.p, s.clearance, v.surface.ng, e.wi);
    vec3 target =
        leave_surface(e.q, surface_clearance(e.q_error, e.q_normal), e.q_normal, neg3(e.wi));
    ray.direction = sel3(e.distant, e.wi, sub3(target, ray.origin));
    ray.t = sel(e.distant, (Real)INFINITY, shadow_ray_end());
    ray.excluded = s.excluded;
    ray.contribution = d.contribution;
    ray.slot = v.path.slot;
    if (HAS(light_groups)) ray.group = light_group(w.scene.light_groups, d.row, maskBits(d.lanes));
    Mask bad = d.lanes & (nought3(ray.origin) + nought3(ray.direction) != R(0.));
    mark_bad(w.results, v.path.slot, bad, fault_next_event, w.depth);
    return pack_shadow_ray(to, ray, maskBits(d.lanes & !bad));
}

#endif
