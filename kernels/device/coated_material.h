// Materials with what tables tell of their coats.
#ifndef PARHELION_COATED_MATERIAL_H
#define PARHELION_COATED_MATERIAL_H

#include "device/energy_table.h"
#include "device/scene_tables.h"

/// m: as it is seen from wo.
FN BsdfEval eval_material(SceneTables scene, Material m, vec3 wo, vec3 wi, Mask lanes) {
    if (HAS(bsdf_roughplastic)) {
        Mask coated = lanes & (m.kind == material_roughplastic);
        if (someLane(coated)) m = coat_lit_from(scene.energy_tables, m, wi, coated);
    }
    return bsdf_eval(m, wo, wi);
}

/// What the coat lets in from the direction that is drawn is known behind the draw: until then the
/// base is black.
FN BsdfSample sample_material(SceneTables scene, Material m, vec3 wo, vec2 u, Real u_lobe,
                              Mask lanes) {
    BsdfSample s = bsdf_sample(m, wo, u, u_lobe);
    if (HAS(bsdf_roughplastic)) {
        Mask coated = lanes & (m.kind == material_roughplastic) & (s.pdf > R(0.));
        if (someLane(coated)) {
            m = coat_lit_from(scene.energy_tables, m, s.wi, coated);
            vec3 base = bsdf_roughplastic_base(m, s.wi);
            vec3 weight = add3(s.weight, scale3(base, R(1.) / sel(coated, s.pdf, R(1.))));
            s.weight = sel3(coated, weight, s.weight);
        }
    }
    return s;
}

#endif
