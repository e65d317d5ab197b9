// Dispatch to the BSDF of each lane's material, made from the list of materials.

FN BsdfEval bsdf_eval(Material m, vec3 wo, vec3 wi) {
    BsdfEval result = bsdf_eval_none();
#define BSDF_EVAL_CASE(name, ...)                                                                  \
    if (HAS(bsdf_##name)) {                                                                        \
        Mask mine = m.kind == material_##name;                                                     \
        if (someLane(mine)) {                                                                      \
            BsdfEval e = bsdf_##name##_eval(m, wo, wi);                                            \
            result.f = sel3(mine, e.f, result.f);                                                  \
            result.pdf = sel(mine, e.pdf, result.pdf);                                             \
        }                                                                                          \
    }
    MATERIALS(BSDF_EVAL_CASE)
    return result;
}

/// u chooses the direction, u_lobe between reflection and transmission; all in [0, 1).
FN BsdfSample bsdf_sample(Material m, vec3 wo, vec2 u, Real u_lobe) {
    BsdfSample result = bsdf_sample_none();
#define BSDF_SAMPLE_CASE(name, ...)                                                                \
    if (HAS(bsdf_##name)) {                                                                        \
        Mask mine = m.kind == material_##name;                                                     \
        if (someLane(mine)) {                                                                      \
            BsdfSample s = bsdf_##name##_sample(m, wo, u, u_lobe);                                 \
            result.wi = sel3(mine, s.wi, result.wi);                                               \
            result.weight = sel3(mine, s.weight, result.weight);                                   \
            result.pdf = sel(mine, s.pdf, result.pdf);                                             \
            result.eta = sel(mine, s.eta, result.eta);                                             \
        }                                                                                          \
    }
    MATERIALS(BSDF_SAMPLE_CASE)
    return result;
}
