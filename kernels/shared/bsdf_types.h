// Conventions of all BSDFs, and what they return.
//
// Local space, shading normal = +z. `wo` points toward the viewer, `wi` is the sampled direction,
// toward the light. eval returns f * |cos(wi)|; pdf is in solid angle. A surface that looks
// different from below is turned over before it gets here, so one-sided materials need only answer
// for wo.z > 0; they return 0 and do not scatter for wo.z <= 0. Radiance that crosses into a medium
// of relative index eta is scaled by 1 / eta^2 (Veach 1997, section 5.2).

typedef struct {
    vec3 f;   // f * |cos(wi)|, 1/sr; 0 for delta lobes
    Real pdf; // 1/sr
} BsdfEval;

typedef struct {
    vec3 wi;
    vec3 weight; // f * |cos(wi)| / pdf; 0 where nothing is scattered
    Real pdf;    // 1/sr; infinite for a delta lobe
    Real eta; // index beyond / index here for a path that crosses the surface, 1 for one that stays
} BsdfSample;

FN BsdfEval bsdf_eval_none(void) {
    BsdfEval e;
    e.f = splat3(R(0.));
    e.pdf = R(0.);
    return e;
}

FN BsdfSample bsdf_sample_none(void) {
    BsdfSample s;
    s.wi = v3(R(0.), R(0.), R(1.));
    s.weight = splat3(R(0.));
    s.pdf = R(0.);
    s.eta = R(1.);
    return s;
}

FN vec3 material_reflectance(Material m) { return v3(m.r, m.g, m.b); }
FN vec3 material_transmittance(Material m) { return v3(m.tr, m.tg, m.tb); }
FN vec3 material_eta(Material m) { return v3(m.er, m.eg, m.eb); }
FN vec3 material_k(Material m) { return v3(m.kr, m.kg, m.kb); }

/// Whether it answers for its upper side alone: by its kind, or as its record says (materials.h).
FN Mask material_is_opaque(Material m) {
    Mask opaque = ((((Int)1) << m.kind) & OPAQUE_MATERIALS) != 0;
    if (HAS(bsdf_principled))
        opaque = opaque | ((m.kind == material_principled) & ((m.distribution & 1) != 0));
    return opaque;
}

/// The interface of a dielectric seen from outside (`outside`) or from within; types.h says where
/// its numbers live.
FN Interface material_interface(Material m, Mask outside) {
    Interface i;
    i.eta = sel(outside, m.er, m.eg);
    i.inv_eta = sel(outside, m.eg, m.er);
    i.m_high = sel(outside, m.eb, m.kg);
    i.m_low = sel(outside, m.kr, m.kb);
    return i;
}
