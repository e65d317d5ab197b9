// Shadow rays through surfaces that are not there, or not all of them: masks let light through.
//
// What is opaque has been looked for before, in a tree of its own. The others, where they lie in a
// ray's way, are met one after the other, as by a path that goes straight on there. Who includes
// this knows how rays meet them: path_to_clear.
#ifndef PARHELION_SHADOW_CLEAR_H
#define PARHELION_SHADOW_CLEAR_H

#include "device/lobes.h"
#include "device/path_vertex.h"

/// Share of light that goes straight on where the lanes are. What has two sides lets as much
/// through from either.
FN Real clear_share(SceneTables scene, PathVertex v) {
    Int code = v.primitive.stored.material;
    TexturePlace place = texture_place(v);
    Mask single = v.hit & (code >= 0);
    Material m = load_Material(scene.materials, sel(single, code, (Int)0));
    Real share = sel(single & (m.kind == material_null), R(1.), R(0.));
    if (!HAS(blends)) return share;
    Int blend = sel(v.hit, code, (Int)(-1));
    for (LobeWalk l = first_lobe(scene, blend, place); someLane(l.inside);
         l = next_lobe(scene, l, place)) {
        m = load_Material(scene.materials, sel(l.inside, l.lobe.material, (Int)0));
        Mask clear = l.inside & (m.kind == material_null);
        share = sel(clear, share + l.lobe.weight, share);
    }
    return share;
}

/// A shadow ray that goes on from what it has met to where it ends.
FN Path clear_ray_behind(Path p, PathVertex v, vec3 end, Mask distant) {
    vec3 clearance = surface_clearance(v.surface.error, v.surface.ng);
    p.origin = leave_surface(v.surface.p, clearance, v.surface.ng, p.direction);
    p.direction = sel3(distant, p.direction, sub3(end, p.origin));
    p.t = sel(distant, (Real)INFINITY, shadow_ray_end());
    p.excluded = excluded_behind(v);
    return p;
}

/// What arrives of the light of the open shadow rays that begin at `depth`. They meet no more
/// surfaces than paths do.
FN Real clear_way(SceneTables scene, RenderParams params, StatePlace place, Mask open, int depth) {
    Path p;
    p.origin = ray_at_origin(place);
    p.direction = ray_at_direction(place);
    p.t = ray_at_t(place);
    p.excluded = ray_at_excluded(place);
    Mask distant = p.t == (Real)INFINITY;
    vec3 end = add3(p.origin, p.direction);
    Real share = R(1.);
    for (Mask going = open; someLane(going); depth++) {
        p = path_to_clear(scene, params, p, going);
        going = going & (p.primitive >= 0);
        PathVertex v = vertex_of(p, going, scene);
        Real clear = clear_share(scene, v);
        if (depth + 2 >= params.max_depth) clear = R(0.);
        share = sel(going, share * clear, share);
        going = going & (share > R(0.));
        p = clear_ray_behind(p, v, end, distant);
    }
    return share;
}

#endif
