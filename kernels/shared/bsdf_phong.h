// Modified Phong model (Lafortune and Willems 1994, "Using the modified Phong reflectance model for
// physically based rendering"), as in Mitsuba 0.6: a power of the cosine to the mirrored direction,
// which at normal incidence sends on its reflectance, beside a matte base.

/// What is left of the lobe in direction wi: cos^n, 0 beyond a right angle. By the distance of the
/// ends of both directions, for the cosine of a small angle has lost its digits; both ways the
/// same.
FN Real phong_power(Material m, vec3 wo, vec3 wi) {
    vec3 apart = sub3(reflect_local(wo), wi);
    Real off = .5f * dot3(apart, apart); // 1 - cos
    Mask inside = off < R(1.);
    return sel(inside, exp_negative(m.alpha_u * log_one_minus(sel(inside, off, R(0.)))), R(0.));
}

FN GlossyLobe phong_lobe(Material m, Real power, vec3 wi) {
    Real scaled = power * R(INV_TWO_PI);
    GlossyLobe lobe;
    lobe.f = (m.alpha_u + R(2.)) * scaled * wi.z;
    lobe.pdf = (m.alpha_u + R(1.)) * scaled;
    return lobe;
}

FN BsdfEval bsdf_phong_eval(Material m, vec3 wo, vec3 wi) {
    Mask reflects = (wo.z > R(0.)) & (wi.z > R(0.));
    return glossy_eval(m, reflects, wi, phong_lobe(m, phong_power(m, wo, wi), wi));
}

/// A direction of the lobe: that it is off by more than an angle has the chance 1 - cos^(n + 1).
FN BsdfSample bsdf_phong_sample(Material m, vec3 wo, vec2 u, Real u_lobe) {
    Real log_cosine = log_unit(R(1.) - u.x) / (m.alpha_u + R(1.));
    Real sine = sqrtR(one_minus_exp(R(2.) * log_cosine)), cosine = exp_negative(log_cosine);
    SinCos phi = sincos_turns(u.y);
    ShadingFrame about = frame_from_normal(reflect_local(wo));
    vec3 glossy = to_world(about, v3(sine * phi.cosine, sine * phi.sine, cosine));
    Mask drawn = u_lobe < glossy_chances(m).glossy;
    vec3 wi = sel3(drawn, glossy, hemisphere_cosine(u));
    // Of a narrow lobe only the angle that was drawn tells where in it a direction lies.
    Real power = sel(drawn, exp_negative(m.alpha_u * log_cosine), phong_power(m, wo, wi));
    Mask reflects = (wo.z > R(0.)) & (wi.z > R(0.));
    return glossy_sample(m, reflects, wi, phong_lobe(m, power, wi));
}
