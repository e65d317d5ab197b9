// Materials as a viewer sees them: with normals that textures tilt, and what tables tell of coats.
#ifndef PARHELION_SEEN_MATERIAL_H
#define PARHELION_SEEN_MATERIAL_H

#include "device/energy_table.h"
#include "device/texture.h"

#define HAS_TILTS (HAS(normal_maps) || HAS(bump_maps))
/// Without light there are no tables.
#define HAS_COATS (HAS(bsdf_roughplastic) && (HAS(next_event) || HAS(scattering)))

typedef struct {
    Material material;
    vec3 wo;            // to the viewer, in its own frame
    ShadingFrame frame; // that one, in the frame of the surface; only if HAS_TILTS
    Mask shadowed;      // by its own tilted facets
} SeenMaterial;

/// What a texture makes of the surface's normal; of some length.
FN vec3 tilted_normal(SceneTables scene, MaterialTextures t, TexturePlace place, Mask tilted) {
    Int row = t.tilt >> TILT_SHIFT;
    vec3 n = v3(R(0.), R(0.), R(1.));
    if (HAS(normal_maps)) {
        Mask mine = tilted & ((t.tilt & TILT_NORMALS) != 0);
        if (someLane(mine)) {
            vec3 c = sub3(scale3(texture_color(scene, row, place, mine), R(2.)), splat3(R(1.)));
            n = sel3(mine, v3(c.x * t.tilt_scale, c.y * t.tilt_scale, c.z), n);
        }
    }
    if (HAS(bump_maps)) {
        Mask mine = tilted & ((t.tilt & TILT_NORMALS) == 0);
        if (someLane(mine)) {
            Texture heights = load_wanted_texture(scene, row, mine);
            vec2 slope = bitmap_gradient(scene, heights, texture_uv(heights, place.uv), mine);
            slope = v2(slope.x * t.tilt_scale, slope.y * t.tilt_scale);
            n = sel3(mine, normal_of_heights(place.du, place.dv, slope), n);
        }
    }
    return n;
}

FN SeenMaterial tilt_material(SceneTables scene, SeenMaterial s, TexturePlace place, Int row,
                              Mask lanes) {
    MaterialTextures t = load_MaterialTextures(scene.material_textures, row);
    Mask tilted = lanes & (t.tilt >= 0);
    if (someLane(tilted)) {
        vec3 n = tilted_normal(scene, t, place, tilted);
        ShadingFrame f = tilted_frame(n, s.wo, (t.tilt & TILT_FLIPS) != 0);
        s.frame.s = sel3(tilted, f.s, s.frame.s);
        s.frame.t = sel3(tilted, f.t, s.frame.t);
        s.frame.n = sel3(tilted, f.n, s.frame.n);
        s.shadowed = tilted & ((t.tilt & TILT_SHADOWS) != 0);
        s.wo = to_local(s.frame, s.wo);
    }
    return s;
}

/// Row `row` of the materials, as textures tell it, from wo in the frame of the surface.
FN SeenMaterial see_material(SceneTables scene, Material m, TexturePlace place, Int row, vec3 wo,
                             Mask lanes) {
    SeenMaterial s;
    s.material = m;
    s.wo = wo;
    s.frame.s = v3(R(1.), R(0.), R(0.));
    s.frame.t = v3(R(0.), R(1.), R(0.));
    s.frame.n = v3(R(0.), R(0.), R(1.));
    s.shadowed = lanes & !lanes;
    if (HAS_TILTS) s = tilt_material(scene, s, place, row, lanes);
    if (HAS_COATS) s.material = coat_seen_from(scene.energy_tables, m, s.wo, lanes);
    return s;
}

/// Share of the light from or to wi, in the frame of the surface, that tilted facets let through;
/// `in_own`: wi in the material's.
FN Real tilt_share(SeenMaterial s, vec3 wi, vec3 in_own) {
    Real share = sel(s.shadowed, facets_shadow(s.frame.n, wi), R(1.));
    return sel(tilted_with(wi, in_own), share, R(0.));
}

FN BsdfEval eval_material(SceneTables scene, SeenMaterial s, vec3 wi, Mask lanes) {
    vec3 in_own = wi;
    if (HAS_TILTS) in_own = to_local(s.frame, wi);
    Material m = s.material;
    if (HAS_COATS) {
        Mask coated = lanes & (m.kind == material_roughplastic);
        if (someLane(coated)) m = coat_lit_from(scene.energy_tables, m, in_own, coated);
    }
    BsdfEval e = bsdf_eval(m, s.wo, in_own);
    if (HAS_TILTS) {
        e.f = scale3(e.f, tilt_share(s, wi, in_own));
        e.pdf = sel(tilted_with(wi, in_own), e.pdf, R(0.));
    }
    return e;
}

/// What the coat lets in from the direction that is drawn is known behind the draw: until then the
/// base is black.
FN BsdfSample sample_material(SceneTables scene, SeenMaterial s, vec2 u, Real u_lobe, Mask lanes) {
    BsdfSample b = bsdf_sample(s.material, s.wo, u, u_lobe);
    if (HAS_COATS) {
        Mask coated = lanes & (s.material.kind == material_roughplastic) & (b.pdf > R(0.));
        if (someLane(coated)) {
            Material m = coat_lit_from(scene.energy_tables, s.material, b.wi, coated);
            vec3 base = bsdf_roughplastic_base(m, b.wi);
            vec3 weight = add3(b.weight, scale3(base, R(1.) / sel(coated, b.pdf, R(1.))));
            b.weight = sel3(coated, weight, b.weight);
        }
    }
    if (HAS_TILTS) {
        vec3 wi = to_world(s.frame, b.wi);
        b.weight = scale3(b.weight, tilt_share(s, wi, b.wi));
        b.pdf = sel(tilted_with(wi, b.wi), b.pdf, R(0.));
        b.wi = wi;
    }
    return b;
}

#endif
