// Shade: what a path does at the surface (or the sky) it reached.
#include "device/device.h"
#include "device/energy_table.h"
#include "device/lanes_memory.h"
#include "device/light_table.h"
#include "device/path_state.h"
#include "device/path_vertex.h"

#include "device/bad_sample.h"
#include "device/camera_lanes.h"

/// Radiance of the sky for lanes that missed everything, weighted against next event estimation;
/// nothing for the hidden ones.
FN vec3 sky_emission(PathVertex v, global const LightRecord* lights, RenderParams params,
                     Mask hidden) {
    Light sky = load_Light(lights, (Int)params.constant_light);
    Real weight = R(1.);
    if (HAS(next_event))
        weight = power_heuristic(v.pdf, emitter_constant_pdf(sky, v.origin, v.direction, v.origin));
    if (HAS(hide_emitters)) weight = sel(hidden, R(0.), weight);
    return scale3(light_radiance(sky), weight);
}

/// Radiance of the emitters the lanes hit, weighted against next event estimation.
FN vec3 surface_emission(PathVertex v, Primitive p, SurfaceInteraction s,
                         global const LightRecord* lights, global const LightNodeRecord* nodes,
                         global const int* leaves) {
    Mask emits = v.hit & (p.light >= 0);
    vec3 emitted = splat3(R(0.));
    if (someLane(emits)) {
        Int row = (Int)0;
        if (HAS(several_lights)) row = sel(emits, p.light, row);
        Light light = load_Light(lights, row);
        // Next event estimation has no part in what the camera or a mirror sees.
        Mask weighted = emits & finiteR(v.pdf);
        if (HAS(next_event))
            light = light_picked_with(light, light_pmf(nodes, leaves, v.origin, row, weighted));
        else
            weighted = emits & !emits;
        EmitterHit e = emitter_hit(light, v.origin, v.direction, s.p, weighted);
        emitted = sel3(emits, e.radiance, emitted);
        if (someLane(weighted))
            emitted = scale3(emitted, sel(weighted, power_heuristic(v.pdf, e.pdf), R(1.)));
    }
    return emitted;
}

FN void write_aovs(global Scalar* results, RenderParams params, PathVertex v, Primitive p,
                   SurfaceInteraction s, Material m) {
    uint bits = maskBits(v.hit);
    long stride = params.result_stride;
    vec3 none = splat3(R(0.));
#define AOV3(kind, value)                                                                          \
    if (params.aov_offset[aov_##kind] >= 0)                                                        \
        add_result3(results, stride, result_field_count + params.aov_offset[aov_##kind], v.slot,   \
                    sel3(v.hit, value, none), bits);
#define AOV1(kind, channel, value)                                                                 \
    if (params.aov_offset[aov_##kind] >= 0)                                                        \
        scatter_add(results +                                                                      \
                        (result_field_count + params.aov_offset[aov_##kind] + channel) * stride,   \
                    v.slot, value, bits);
    AOV3(albedo, material_reflectance(m))
    AOV3(sh_normal, s.ns)
    AOV3(geo_normal, s.ng)
    AOV3(position, s.p)
    AOV1(position, 3, R(1.))
    AOV1(uv, 0, s.uv.x)
    AOV1(uv, 1, s.uv.y)
    AOV1(depth, 0, camera_distance(camera_lanes(params.camera), v.origin, v.t))
    AOV1(shape_index, 0, toReal(p.shape + 1))
    AOV1(prim_index, 0, toReal(p.index_in_shape))
}

/// The direction of w, given in the frame of a surface that was turned over where side is -1.
FN vec3 to_world_from(ShadingFrame frame, vec3 w, Real side) {
    w.z = w.z * side;
    return to_world(frame, w);
}

/// Reads: path state, scene. Writes: results (emission, alpha, AOVs at the first vertex), counts,
/// path and shadow state. Pushes: a shadow ray for each vertex with light to receive, a path for
/// each that goes on; both packed in place.
kernel void shade(KERNEL_PARAMETERS) {
    CHECK_BOUNDS();
    int segment = get_global_id(0);
    int base = segment * params.segment_stride;
    int end = base + AT(global int, counts, 2 * segment);
    int next_path = base, next_shadow = base;
    long stride = params.result_stride;
    for (int at = base; at < end; at += LANES) {
        PathVertex v = load_vertex_state(path_state, params, at, end - at);
        Primitive primitive = load_Primitive(primitives, v.primitive);
        SurfaceInteraction surface = surface_at(primitive, v, vertices);

        Mask bad_hit = v.hit & (nought3(surface.p) + nought3(surface.ns) != v.t * R(0.));
        v.hit = v.hit & !bad_hit;

        // ---- what is seen
        vec3 seen = splat3(R(0.));
        if (HAS(view_normals)) seen = scale3(add3(surface.ns, splat3(R(1.))), R(.5));
        if (HAS(view_depth))
            seen = splat3(camera_distance(camera_lanes(params.camera), v.origin, v.t));
        if (HAS(view_normals) || HAS(view_depth)) seen = sel3(v.hit, seen, splat3(R(0.)));
        if (HAS(emission)) {
            seen = add3(seen,
                        surface_emission(v, primitive, surface, lights, light_nodes, light_leaves));
            if (HAS(emitter_constant)) {
                Mask sky = v.active & !v.hit, hidden = v.active & !v.active;
                if (depth == 0) hidden = v.active;
                if (HAS(hide_emitters) && HAS(straight_through))
                    hidden = uncovered(results, stride, v);
                if (someLane(sky)) seen = sel3(sky, sky_emission(v, lights, params, hidden), seen);
            }
        }
        Mask bad_emission = v.active & !v.active;
        if (HAS(emission) || depth == 0) {
            vec3 gathered = mul3(v.throughput, seen);
            bad_emission = v.active & (nought3(gathered) != R(0.));
            uint seen_bits = maskBits(v.active & (max_component(seen) != R(0.)));
            if (seen_bits) add_result3(results, stride, result_r, v.slot, gathered, seen_bits);
        }
        if (HAS(straight_through)) {
            Mask covered = v.hit & (max_component(seen) != R(0.));
            if (params.sky_covers) covered = v.active;
            cover(results, stride, v, covered);
        } else if (depth == 0) {
            Mask covered = v.hit;
            if (params.sky_covers) covered = v.active;
            scatter_add(RESULT(result_alpha), v.slot, R(1.), maskBits(covered));
        }
        mark_bad(results, stride, v.slot, bad_hit, fault_hit, depth);
        mark_bad(results, stride, v.slot, bad_emission, fault_emission, depth);

        // ---- the material of the side that is looked at
        Mask need_material = v.hit;
        SurfaceInteraction shaded = surface;
        ShadingSide sides;
        sides.n = surface.ns;
        sides.g = surface.ng;
        if (HAS(consistent_normals)) {
            sides = shading_side(surface.ns, surface.ng, neg3(v.direction));
            shaded.ns = sides.n;
        }
        ShadingFrame frame = surface_frame(shaded);
        vec3 wo = to_local(frame, neg3(v.direction));
        Int material_row = primitive.material_front;
        if (HAS(back_materials))
            material_row = sel(wo.z < R(0.), primitive.material_back, material_row);
        need_material = need_material & (material_row >= 0);
        // A side without material absorbs; AOVs still show the front's.
        Int shown_row = sel(material_row >= 0, material_row, primitive.material_front);
        Material material = load_Material(materials, sel(shown_row >= 0, shown_row, (Int)0));
        if (HAS(aovs) && depth == 0) {
            Mask bad = nought3(material_reflectance(material)) + nought3(surface.ng) !=
                       (surface.uv.x + surface.uv.y) * R(0.);
            mark_bad(results, stride, v.slot, v.hit & bad, fault_aov, depth);
            write_aovs(results, params, v, primitive, surface, material);
        }
        Mask may_pass = v.active & !v.active;
        if (HAS(straight_through)) {
            may_pass = passing_surface(need_material, material);
            cover(results, stride, v, v.hit & !may_pass);
        }
        if (depth + 1 >= params.max_depth) continue;
        Real side = R(1.);
        if (HAS(back_materials)) {
            Mask turn = (wo.z < R(0.)) & (((((Int)1) << material.kind) & OPAQUE_MATERIALS) != 0);
            side = sel(turn, R(-1.), R(1.));
            wo.z = wo.z * side;
        }

        if (HAS(energy_compensation))
            v.throughput =
                mul3(v.throughput, compensate_energy(energy_tables, material, wo, need_material));

        Int excluded = sel(primitive_kind(primitive) == geometry_sphere, (Int)(-1), v.primitive);
        vec3 clearance = surface_clearance(surface.error, surface.ng);
        SampleNumber number = sample_number(asUint(v.pixel), asUint(v.sample),
                                            (Uint)(uint)params.seed, params.replicate_bits);

        // ---- next event estimation: one shadow ray with its finished contribution
        if (HAS(next_event)) {
            Random4 r = sampler_draw(number, bounce_set(depth, draw_emitter));
            // Seen from where rays to this side begin, as by a ray of the BSDF's choice that meets
            // the light: next to an emitter even the clearance changes its solid angle.
            vec3 from = leave_surface(surface.p, clearance, surface.ng, neg3(v.direction));
            LightPick pick = pick_light(light_nodes, from, shaded.ns, need_material, r.x, r.y);
            Mask reached = need_material & !(pick.pmf <= R(0.));
            Light light =
                light_picked_with(load_Light(lights, pick.row), sel(reached, pick.pmf, R(1.)));
            EmitterSample e = emitter_sample(light, from, uniform2(r.z, r.w));
            vec3 wi = to_local(frame, e.wi);
            wi.z = wi.z * side;
            BsdfEval f = bsdf_eval(material, wo, wi);
            Real weight = R(1.);
            if (HAS(emission) && HAS(scattering)) {
                // A ray that meets the light does not know how this surface lies.
                Real inverse_hint = e.inverse_pdf;
                if (HAS(light_tree))
                    inverse_hint = e.inverse_pdf * (pick.pmf / sel(reached, pick.pmf_hint, R(1.)));
                weight = power_heuristic_inverse(inverse_hint, f.pdf);
            }
            if (HAS(consistent_normals)) weight = weight * counted_share(sides, material, e.wi);
            vec3 contribution = scale3(mul3(mul3(v.throughput, f.f), e.weight), weight);
            Mask bad = reached & (nought3(contribution) != R(0.));
            mark_bad(results, stride, v.slot, bad, fault_next_event, depth);
            Mask lit = reached & (max_component(contribution) > R(0.)) & !bad;
            uint bits = maskBits(lit);
            if (bits) {
                vec3 origin = leave_surface(surface.p, clearance, surface.ng, e.wi);
                vec3 target = leave_surface(e.q, surface_clearance(e.q_error, e.q_normal),
                                            e.q_normal, neg3(e.wi));
                vec3 to_light = sel3(e.distant, e.wi, sub3(target, origin));
                bad = lit & (nought3(origin) + nought3(to_light) != R(0.));
                mark_bad(results, stride, v.slot, bad, fault_next_event, depth);
                bits = maskBits(lit & !bad);
                int to = next_shadow;
                SHADOW_PACK_REAL(ox, origin.x);
                SHADOW_PACK_REAL(oy, origin.y);
                SHADOW_PACK_REAL(oz, origin.z);
                SHADOW_PACK_REAL(dx, to_light.x);
                SHADOW_PACK_REAL(dy, to_light.y);
                SHADOW_PACK_REAL(dz, to_light.z);
                SHADOW_PACK_REAL(t, sel(e.distant, (Real)INFINITY, shadow_ray_end()));
                SHADOW_PACK_REAL(r, contribution.x);
                SHADOW_PACK_REAL(g, contribution.y);
                SHADOW_PACK_REAL(b, contribution.z);
                SHADOW_PACK_INT(slot, v.slot);
                SHADOW_PACK_INT(excluded, excluded);
                next_shadow += popcount(bits);
            }
        }

        // ---- go on in a direction of the BSDF's choice
        // Where rays meet no light and cover nothing, the last one is of no use.
        int useful = HAS(emission) || HAS(straight_through) || depth + 2 < params.max_depth;
        if (HAS(scattering) && useful) {
            Random4 r = sampler_draw(number, bounce_set(depth, draw_bsdf));
            BsdfSample b = bsdf_sample(material, wo, uniform2(r.x, r.y), uniform01(r.z));
            vec3 throughput = mul3(v.throughput, b.weight);
            if (HAS(consistent_normals)) {
                vec3 direction = to_world_from(frame, b.wi, side);
                throughput = scale3(throughput, counted_share(sides, material, direction));
            }
            Real eta_scale = v.eta_scale * b.eta;
            Mask bad = need_material & (nought3(throughput) != R(0.));
            mark_bad(results, stride, v.slot, bad, fault_bsdf, depth);
            Mask alive = need_material & (max_component(throughput) > R(0.)) & !bad;
            if (HAS(straight_through)) {
                Mask passes = may_pass & (wo.z * b.wi.z < R(0.));
                cover(results, stride, v, may_pass & !passes);
                // Without light there is but to see what stands behind.
                if (!(HAS(emission) || HAS(next_event))) alive = alive & passes;
            }
            if (HAS(russian_roulette) && depth + 1 >= params.rr_depth) {
                Roulette roulette = russian_roulette(throughput, eta_scale, uniform01(r.w));
                alive = alive & roulette.alive;
                throughput = scale3(throughput, roulette.scale);
            }
            uint bits = maskBits(alive);
            if (bits) {
                vec3 direction = to_world_from(frame, b.wi, side);
                vec3 origin = leave_surface(surface.p, clearance, surface.ng, direction);
                bad = alive & ((nought3(origin) + nought3(direction) != R(0.)) | (b.pdf != b.pdf));
                mark_bad(results, stride, v.slot, bad, fault_bsdf, depth);
                bits = maskBits(alive & !bad);
                int to = next_path;
                PATH_PACK_REAL(ox, origin.x);
                PATH_PACK_REAL(oy, origin.y);
                PATH_PACK_REAL(oz, origin.z);
                PATH_PACK_REAL(dx, direction.x);
                PATH_PACK_REAL(dy, direction.y);
                PATH_PACK_REAL(dz, direction.z);
                PATH_PACK_REAL(t, (Real)INFINITY);
                PATH_PACK_REAL(tr, throughput.x);
                PATH_PACK_REAL(tg, throughput.y);
                PATH_PACK_REAL(tb, throughput.z);
                PATH_PACK_REAL(pdf, b.pdf);
                PATH_PACK_REAL(eta_scale, eta_scale);
                PATH_PACK_INT(slot, v.slot);
                PATH_PACK_INT(pixel, v.pixel);
                PATH_PACK_INT(sample, v.sample);
                PATH_PACK_INT(excluded, excluded);
                next_path += popcount(bits);
            }
        }
    }
    AT(global int, counts, 2 * segment) = next_path - base;
    AT(global int, counts, 2 * segment + 1) = next_shadow - base;
}
