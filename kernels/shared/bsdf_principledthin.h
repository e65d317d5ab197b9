// Burley's principled material of a thin sheet, as in Mitsuba 3: what goes through is not bent. A
// rough mirror, the same turned to the other side, a little sharper; a matte side, with sheen; and
// a matte other side. Both sides of it are alike.

typedef struct {
    Interface face;
    vec3 base, hue;
    vec2 mirroring, passing; // roughness of either way
    Real matte, through;     // shares of what is spread, to this side and to the other
    Real mirrors, passes, spreads, spreads_through; // chances
} PrincipledThin;

FN PrincipledThin chances_of_sheet(Material m, PrincipledThin p, Real cosine) {
    Real base = mean_component(p.base), head_on = head_on_reflectance(m.er);
    vec3 tint = mix3(splat3(R(1.)), p.hue, SPEC_TINT(m));
    p.mirrors = p.passes = R(0.);
    if (HAS(spec_trans)) {
        p.mirrors = SPEC_TRANS(m) * likely_reflectance(head_on * mean_component(tint), cosine);
        p.passes = SPEC_TRANS(m) * base * (R(1.) - likely_reflectance(head_on, cosine));
    }
    p.spreads = p.matte * base, p.spreads_through = p.through * base;
    if (HAS(sheen)) p.spreads = p.spreads + SHEEN_MOST * SHEEN(m) * p.matte;
    Real sum = (p.mirrors + p.passes) + (p.spreads + p.spreads_through);
    Real scale = R(1.) / sel(sum > R(0.), sum, R(1.));
    p.mirrors = p.mirrors * scale, p.passes = p.passes * scale;
    p.spreads = p.spreads * scale, p.spreads_through = p.spreads_through * scale;
    return p;
}

FN PrincipledThin principledthin_at(Material m, vec3 o) {
    PrincipledThin p;
    p.face = interface_of_index(m.er, o.z == o.z);
    p.base = material_reflectance(m);
    p.hue = hue_of(p.base);
    p.mirroring = principled_alphas(m.alpha_u, m.alpha_v);
    // Burley 2015, figure 15.
    p.passing = principled_alphas((R(.65) * m.er - R(.35)) * m.alpha_u, m.alpha_v);
    Real spread = R(1.), through = .5f * DIFF_TRANS(m);
    if (HAS(spec_trans)) spread = rest_of(SPEC_TRANS(m));
    p.matte = spread * rest_of(through);
    p.through = spread * through;
    return chances_of_sheet(m, p, o.z);
}

/// Roughness of the way that light takes.
FN vec2 sheet_alpha(PrincipledThin p, Mask stays) {
    return v2(sel(stays, p.mirroring.x, p.passing.x), sel(stays, p.mirroring.y, p.passing.y));
}

/// For o above, and the normal that sends it to i_up, which is i or its mirror image above.
FN BsdfEval principledthin_value(Material m, PrincipledThin p, vec3 o, vec3 i, vec3 h) {
    Mask stays = i.z > R(0.);
    Real up = absR(i.z), cosine = dot3(o, h);
    Material base = m;
    base.r = m.r * p.matte, base.g = m.g * p.matte, base.b = m.b * p.matte;
    vec3 reflected = spread_by_base(base, p.hue, p.matte * SHEEN(m), o.z, up, cosine);
    BsdfEval e;
    e.f = sel3(stays, reflected, scale3(p.base, p.through * up * R(INV_PI)));
    e.pdf = sel(stays, p.spreads, p.spreads_through) * (up * R(INV_PI));
    if (HAS(spec_trans)) {
        Fresnel f = fresnel_dielectric(cosine, p.face);
        Real schlick = schlick_weight_at(cosine, f, p.face);
        vec3 mirrored = tinted_fresnel(m, f, schlick, p.hue, m.er);
        vec2 alpha = sheet_alpha(p, stays);
        Real density = .25f * ggx_visible_d(o, h, alpha.x, alpha.y);
        Real value = SPEC_TRANS(m) * density * ggx_g1(v3(i.x, i.y, up), alpha.x, alpha.y);
        vec3 color = sel3(stays, mirrored, scale3(p.base, f.transmittance));
        e.f = add3(e.f, scale3(color, value));
        e.pdf = e.pdf + sel(stays, p.mirrors, p.passes) * density;
    }
    return e;
}

FN BsdfEval bsdf_principledthin_eval(Material m, vec3 wo, vec3 wi) {
    Mask usable = (wo.z != R(0.)) & (wi.z != R(0.));
    Real side = copysignR(R(1.), wo.z);
    vec3 up = v3(R(0.), R(0.), R(1.));
    vec3 o = sel3(usable, scale3(wo, side), up), i = sel3(usable, scale3(wi, side), up);
    vec3 h = normalize3(add3(o, v3(i.x, i.y, absR(i.z))));
    BsdfEval e = principledthin_value(m, principledthin_at(m, o), o, i, h);
    e.f = sel3(usable, e.f, splat3(R(0.)));
    e.pdf = sel(usable, e.pdf, R(0.));
    return e;
}

FN BsdfSample bsdf_principledthin_sample(Material m, vec3 wo, vec2 u, Real u_lobe) {
    BsdfSample s = bsdf_sample_none();
    Mask usable = wo.z != R(0.);
    Real side = copysignR(R(1.), wo.z);
    vec3 up = v3(R(0.), R(0.), R(1.));
    vec3 o = sel3(usable, scale3(wo, side), up);
    PrincipledThin p = principledthin_at(m, o);
    Mask stays = u_lobe < p.spreads, spreads = u_lobe < p.spreads + p.spreads_through;
    vec3 i = hemisphere_cosine(u), h = up;
    if (HAS(spec_trans)) {
        stays = stays | (!spreads & (u_lobe < p.spreads + p.spreads_through + p.mirrors));
        vec2 alpha = sheet_alpha(p, stays);
        h = ggx_sample_visible(o, alpha.x, alpha.y, u);
        i = sel3(spreads, i, reflect_about(o, h));
    }
    usable = usable & (i.z > R(0.));
    i = sel3(usable, i, up);
    h = sel3(usable & !spreads, h, normalize3(add3(o, i)));
    i.z = sel(stays, i.z, -i.z);
    BsdfEval e = principledthin_value(m, p, o, i, h);
    usable = usable & (e.pdf > R(0.));
    s.wi = sel3(usable, scale3(i, side), s.wi);
    s.weight = sel3(usable, scale3(e.f, R(1.) / sel(usable, e.pdf, R(1.))), s.weight);
    s.pdf = sel(usable, e.pdf, R(0.));
    return s;
}
