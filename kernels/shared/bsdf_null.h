// No surface at all: every ray goes straight on.

FN BsdfEval bsdf_null_eval(Material m, vec3 wo, vec3 wi) { return bsdf_eval_none(); }

FN BsdfSample bsdf_null_sample(Material m, vec3 wo, vec2 u, Real u_lobe) {
    BsdfSample s = bsdf_sample_none();
    s.wi = neg3(wo);
    s.weight = splat3(R(1.));
    s.pdf = LANE_INFINITY;
    return s;
}
