// Going on in a direction of the BSDF's choice.
#ifndef PARHELION_SHADE_SCATTER_H
#define PARHELION_SHADE_SCATTER_H

#include "device/shade_lobes.h"

typedef struct {
    Mask lanes; // that go on
    vec3 wi;    // in the frame
    vec3 throughput;
    Real pdf, eta_scale;
} Scattered;

/// The direction of w, given in the frame of a surface that was turned over where side is -1.
FN vec3 to_world_from(ShadingFrame frame, vec3 w, Real side) {
    w.z = w.z * side;
    return to_world(frame, w);
}

/// Of the lanes, those that go on where some have gone straight through. Writes: results (alpha).
FN Mask pass_straight(ShadeWork w, PathVertex v, Shading s, vec3 wi, Mask lanes) {
    Mask passes = s.may_pass & (s.wo.z * wi.z < R(0.));
    cover(w.results, v, s.may_pass & !passes);
    // Without light there is but to see what stands behind.
    if (!(HAS(emission) || HAS(next_event))) lanes = lanes & passes;
    return lanes;
}

/// Writes: results (alpha, what went wrong).
FN Scattered scattered(ShadeWork w, PathVertex v, Shading s) {
    Random4 r = sampler_draw(s.number, bounce_set(w.depth, draw_bsdf));
    NOTE(bsdf_draw, r);
    BsdfSample b = sample_material(w.scene, s.seen, uniform2(r.x, r.y), uniform01(r.z), s.lanes);
    if (HAS(blends)) b = sample_of_all_lobes(w, s, b, to_world_from(s.frame, b.wi, s.side));
    NOTE(scattered, b);
    Scattered out;
    out.wi = b.wi;
    out.pdf = b.pdf;
    out.eta_scale = v.path.eta_scale * b.eta;
    out.throughput = mul3(s.throughput, b.weight);
    if (!HAS(blends) && HAS(consistent_normals)) {
        vec3 direction = to_world_from(s.frame, b.wi, s.side);
        Real share = counted_share(s.sides, s.material, direction);
        NOTE(scattered_share, share);
        out.throughput = scale3(out.throughput, share);
    }
    Mask bad = s.lanes & (nought3(out.throughput) != R(0.));
    mark_bad(w.results, v.path.slot, bad, fault_bsdf, w.depth);
    out.lanes = s.lanes & (max_component(out.throughput) > R(0.)) & !bad;
    if (HAS(straight_through)) out.lanes = pass_straight(w, v, s, b.wi, out.lanes);
    if (HAS(russian_roulette) && w.depth + 1 >= w.params->rr_depth) {
        Roulette roulette = russian_roulette(out.throughput, out.eta_scale, uniform01(r.w));
        NOTE(roulette, roulette);
        out.lanes = out.lanes & roulette.alive;
        out.throughput = scale3(out.throughput, roulette.scale);
    }
    return out;
}

/// Pushes the paths that go on; how many. Writes: results (what went wrong).
FN int continue_paths(ShadeWork w, PathVertex v, Shading s, Scattered onward, StatePlace to) {
    if (!maskBits(onward.lanes)) return 0;
    Path path = v.path;
    path.direction = to_world_from(s.frame, onward.wi, s.side);
    path.origin = leave_surface(v.surface.p, s.clearance, v.surface.ng, path.direction);
    path.t = (Real)INFINITY;
    path.excluded = s.excluded;
    path.throughput = onward.throughput;
    path.pdf = onward.pdf;
    if (HAS(clear_shadows) && HAS(emission)) {
        // As if nothing had been there: light sampled before shines through, too.
        Mask nothing = s.material.kind == material_null;
        path.pdf = sel(nothing, v.path.pdf, path.pdf);
        path.scattered_at = sel3(nothing, v.path.scattered_at, path.origin);
    }
    path.eta_scale = onward.eta_scale;
    Mask bad = (nought3(path.origin) + nought3(path.direction) != R(0.)) | (path.pdf != path.pdf);
    bad = bad & onward.lanes;
    mark_bad(w.results, v.path.slot, bad, fault_bsdf, w.depth);
    return pack_path(to, path, maskBits(onward.lanes & !bad));
}

#endif
