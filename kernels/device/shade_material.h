// The material of the side that is looked at, and what scattering there starts from.
#ifndef PARHELION_SHADE_MATERIAL_H
#define PARHELION_SHADE_MATERIAL_H

#include "device/coverage.h"
#include "device/energy_table.h"
#include "device/notes.h"
#include "device/shade_work.h"
#include "device/texture.h"

typedef struct {
    Mask lanes;        // on a side that has a material
    Mask may_pass;     // of those, where a ray may go straight through
    Material material; // of lanes without: the front's, for AOVs
    ShadingSide sides;
    ShadingFrame frame;
    vec3 wo;   // in the frame
    Real side; // -1 where the surface was turned over to be seen from above
    // What starts here: a light and a direction.
    vec3 throughput, clearance;
    Int excluded;
    SampleNumber number;
} Shading;

/// Where textures are looked up.
FN TexturePlace texture_place(PathVertex v) {
    TexturePlace place;
    place.uv = v.surface.uv;
    place.primitive = v.path.primitive;
    place.shape = PRIMITIVE_SHAPE(v.primitive.stored.shape);
    place.b1 = v.path.b1;
    place.b2 = v.path.b2;
    return place;
}

/// A side without material absorbs; AOVs still show the front's.
FN Shading shading_at(ShadeWork w, PathVertex v) {
    Shading s;
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
    Int front = v.primitive.stored.material, row = front;
    if (HAS(back_materials))
        row = sel(s.wo.z < R(0.), shape_of(w.scene, v.primitive).material_back, row);
    s.lanes = v.hit & (row >= 0);
    row = sel(row >= 0, row, front);
    row = sel(row >= 0, row, (Int)0);
    s.material = load_Material(w.scene.materials, row);
    if (HAS(textures))
        s.material = resolve_textures(w.scene, row, texture_place(v), v.hit, s.material);
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

/// Ready for light and for scattering.
FN Shading turned_to_viewer(ShadeWork w, PathVertex v, Shading s) {
    s.side = R(1.);
    if (HAS(back_materials)) {
        Mask opaque = ((((Int)1) << s.material.kind) & OPAQUE_MATERIALS) != 0;
        s.side = sel((s.wo.z < R(0.)) & opaque, R(-1.), R(1.));
        s.wo.z = s.wo.z * s.side;
    }
    s.throughput = v.path.throughput;
    if (HAS(energy_compensation)) {
        vec3 gain = compensate_energy(w.scene.energy_tables, s.material, s.wo, s.lanes);
        NOTE(energy_gain, gain);
        s.throughput = mul3(s.throughput, gain);
    }
    s.clearance = surface_clearance(v.surface.error, v.surface.ng);
    Mask round = primitive_kind(v.primitive.whole) == geometry_sphere;
    s.excluded = sel(round, (Int)(-1), v.path.primitive);
    s.number = sample_number(asUint(v.path.pixel), asUint(v.path.sample),
                             (Uint)(uint)w.params->seed, w.params->replicate_bits);
    return s;
}

#endif
