// The material of the side that is looked at, and what scattering there starts from.
#ifndef PARHELION_SHADE_MATERIAL_H
#define PARHELION_SHADE_MATERIAL_H

#include "device/coverage.h"
#include "device/lobes.h"
#include "device/material_textures.h"
#include "device/notes.h"
#include "device/seen_material.h"
#include "device/shade_work.h"

typedef struct {
    Mask lanes;    // on a side that has a material
    Mask may_pass; // of those, where a ray may go straight through
    TexturePlace place;
    Int code;          // what they are made of; of lanes without: the front, for AOVs
    Int row;           // of that, or of the lobe of it that a direction is drawn from
    Material material; // which is this
    ChosenLobe lobe;
    ShadingSide sides;
    ShadingFrame frame;
    vec3 wo;           // in the frame
    Real side;         // -1 where the surface was turned over to be seen from above
    SeenMaterial seen; // from there
    // What starts here: a light and a direction.
    vec3 throughput, clearance;
    Int excluded;
    SampleNumber number;
} Shading;

/// What the side that is looked at is made of (materials.h).
FN Int side_code(ShadeWork w, PathVertex v, Mask below) {
    Int code = v.primitive.stored.material;
    if (HAS(back_materials)) code = sel(below, shape_of(w.scene, v.primitive).material_back, code);
    return code;
}

/// A row of the materials, as textures tell it on the lanes.
FN Material material_of_row(ShadeWork w, TexturePlace place, Int row, Mask lanes) {
    Material m = load_Material(w.scene.materials, row);
    if (HAS(textures)) m = resolve_textures(w.scene, row, place, lanes, m);
    return m;
}

/// A side without material absorbs; AOVs still show the front's.
FN Shading shading_at(ShadeWork w, PathVertex v) {
    Shading s;
    s.number = sample_number(asUint(v.path.pixel), asUint(v.path.sample),
                             (Uint)(uint)w.params->seed, w.params->replicate_bits);
    SurfaceInteraction shaded = v.surface;
    s.sides.n = shaded.ns;
    s.sides.g = shaded.ng;
    if (HAS(consistent_normals)) {
        s.sides = shading_side(shaded.ns, shaded.ng, neg3(v.path.direction));
        shaded.ns = s.sides.n;
    }
    s.frame = surface_frame(shaded);
    NOTE(surface, shaded);
    s.wo = to_local(s.frame, neg3(v.path.direction));
    if (HAS(textures)) s.place = texture_place(v);
    if (HAS(bump_maps)) {
        s.place.du = to_local(s.frame, v.surface.tangent);
        s.place.dv = to_local(s.frame, v.surface.tangent_v);
    }
    Int front = v.primitive.stored.material, code = side_code(w, v, s.wo.z < R(0.));
    s.lanes = v.hit & (code != -1);
    s.code = sel(code != -1, code, front);
    Int row = s.code;
    if (HAS(blends)) {
        Random4 r = sampler_draw(s.number, bounce_set(w.depth, draw_lobe));
        NOTE(lobe_draw, r);
        s.lobe = chosen_lobe(w.scene, s.code, s.place, uniform01(r.x));
        row = s.lobe.row;
    }
    NOTE(material, sel(s.lanes, row, (Int)(-1)));
    s.row = sel(row >= 0, row, (Int)0);
    s.material = material_of_row(w, s.place, s.row, v.hit);
    return s;
}

/// Where rays may go straight through, all others cover. Writes: results (alpha).
FN Shading pass_or_cover(ShadeWork w, PathVertex v, Shading s) {
    s.may_pass = v.active & !v.active;
    if (HAS(straight_through)) {
        s.may_pass = passing_surface(s.lanes, s.material);
        cover(w.results, v, v.hit & !s.may_pass);
    }
    return s;
}

/// -1 where a surface of material m is turned over to be seen from below: from wo.z < 0.
FN Real side_to_viewer(Material m, Real z) {
    if (!HAS(back_materials)) return R(1.);
    return sel((z < R(0.)) & material_is_opaque(m), R(-1.), R(1.));
}

/// Ready for light and for scattering.
FN Shading turned_to_viewer(ShadeWork w, PathVertex v, Shading s) {
    s.side = side_to_viewer(s.material, s.wo.z);
    if (HAS(back_materials)) s.wo.z = s.wo.z * s.side;
    s.seen = see_material(w.scene, s.material, s.place, s.row, s.wo, s.lanes);
    s.throughput = v.path.throughput;
    if (!HAS(blends) && HAS(energy_compensation)) { // of blends: shade_lobes.h
        vec3 gain = compensate_energy(w.scene.energy_tables, s.seen.material, s.seen.wo, s.lanes);
        NOTE(energy_gain, gain);
        s.throughput = mul3(s.throughput, gain);
    }
    s.clearance = surface_clearance(v.surface.error, v.surface.ng);
    s.excluded = excluded_behind(v);
    return s;
}

#endif
