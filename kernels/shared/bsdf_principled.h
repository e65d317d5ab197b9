// Burley's principled material, as in Mitsuba 3: one rough interface that mirrors, as metal or as
// glass does, and lets through; a matte base below it, with sheen; and a clear coat. From within
// there is the interface alone.
//
// A direction is drawn from the base, the coat or the interface, by about what each sends on; of
// the interface by a visible normal, and then mirrored or refracted by what that one does.

typedef struct {
    Mask outside;
    Interface face;
    vec2 alpha;
    vec3 base, hue;
    Real matte, glass;           // shares of what is neither metal
    Real spreads, coats, facets; // chances
} Principled;

/// `cosine`: of the viewer.
FN Principled chances_among(Material m, Principled p, Real cosine) {
    Real head_on = head_on_reflectance(m.er), metallic = METALLIC(m);
    vec3 tint = mix3(splat3(R(1.)), p.hue, SPEC_TINT(m));
    vec3 mirrored = add3(scale3(p.base, metallic), scale3(tint, head_on * rest_of(metallic)));
    p.facets = likely_reflectance(mean_component(mirrored), cosine);
    p.spreads = p.matte * mean_component(p.base);
    if (HAS(spec_trans)) {
        vec3 through = v3(sqrtR(p.base.x), sqrtR(p.base.y), sqrtR(p.base.z));
        p.facets = p.facets + p.glass * (R(1.) - head_on) * mean_component(through);
    }
    if (HAS(sheen)) p.spreads = p.spreads + SHEEN_MOST * SHEEN(m) * rest_of(metallic);
    p.coats = R(0.);
    if (HAS(clearcoat)) p.coats = CLEARCOAT_MOST * CLEARCOAT(m);
    p.spreads = sel(p.outside, p.spreads, R(0.));
    p.coats = sel(p.outside, p.coats, R(0.));
    Real scale = R(1.) / (p.facets + p.spreads + p.coats);
    p.facets = p.facets * scale, p.spreads = p.spreads * scale, p.coats = p.coats * scale;
    return p;
}

/// As seen from o, turned to the upper side if it was below.
FN Principled principled_at(Material m, vec3 o, Mask outside) {
    Principled p;
    p.outside = outside;
    p.face = interface_of_index(m.er, outside);
    p.alpha = principled_alphas(m.alpha_u, m.alpha_v);
    p.base = material_reflectance(m);
    p.hue = hue_of(p.base);
    Real no_metal = rest_of(METALLIC(m));
    p.matte = no_metal, p.glass = R(0.);
    if (HAS(spec_trans)) {
        p.matte = no_metal * rest_of(SPEC_TRANS(m));
        p.glass = no_metal * SPEC_TRANS(m);
    }
    return chances_among(m, p, o.z);
}

/// What a facet does with light at that cosine to it; chances of its two ways.
typedef struct {
    Fresnel fresnel;
    Real schlick;
    vec3 mirrored, through;
    Real mirrors, refracts;
} Facet;

FN Facet principled_facet(Material m, Principled p, Real cosine) {
    Facet f;
    f.fresnel = fresnel_dielectric(cosine, p.face);
    f.schlick = schlick_weight_at(cosine, f.fresnel, p.face);
    vec3 metal = mix3(p.base, splat3(R(1.)), f.schlick);
    f.mirrored =
        add3(scale3(metal, METALLIC(m)),
             scale3(tinted_fresnel(m, f.fresnel, f.schlick, p.hue, m.er), rest_of(METALLIC(m))));
    f.through = splat3(R(0.));
    f.mirrors = R(1.), f.refracts = R(0.);
    if (HAS(spec_trans)) {
        f.mirrored = sel3(p.outside, f.mirrored, splat3(p.glass * f.fresnel.reflectance));
        f.through = scale3(v3(sqrtR(p.base.x), sqrtR(p.base.y), sqrtR(p.base.z)),
                           p.glass * f.fresnel.transmittance);
        Real mirrored = mean_component(f.mirrored), through = mean_component(f.through);
        Mask some = mirrored + through > R(0.);
        Real scale = R(1.) / sel(some, mirrored + through, R(1.));
        f.mirrors = sel(some, mirrored * scale, R(1.));
        f.refracts = sel(some, through * scale, R(0.));
    }
    return f;
}

/// Of base and coat.
FN BsdfEval principled_above(Material m, Principled p, vec3 o, vec3 i, vec3 h, Facet f) {
    Real cosine = dot3(o, h), sheen = rest_of(METALLIC(m)) * SHEEN(m);
    // Sheen is not less for what goes through, unlike the rest of the base.
    Material base = m;
    base.r = m.r * p.matte, base.g = m.g * p.matte, base.b = m.b * p.matte;
    BsdfEval e;
    e.f = spread_by_base(base, p.hue, sheen, o.z, i.z, cosine);
    e.pdf = p.spreads * (i.z * R(INV_PI));
    if (HAS(clearcoat)) {
        e.f = add3(e.f, splat3(clearcoat_value(m, o, i, h, f.schlick)));
        e.pdf = e.pdf + p.coats * (.25f * gtr1_d(h, clearcoat_alpha(m)) * h.z / cosine);
    }
    return e;
}

/// For o above, and a normal h that sends one to the other.
FN BsdfEval principled_value(Material m, Principled p, vec3 o, vec3 i, vec3 h) {
    Mask stays = i.z > R(0.);
    Facet f = principled_facet(m, p, dot3(o, h));
    vec3 i_up = v3(i.x, i.y, absR(i.z));
    Real density = .25f * ggx_visible_d(o, h, p.alpha.x, p.alpha.y);
    Real chance = f.mirrors;
    vec3 color = f.mirrored;
    if (HAS(spec_trans)) {
        Real jacobian = half_vector_jacobian(stays, dot3(o, h), dot3(i, h), p.face.eta);
        density = 4.f * density * jacobian;
        chance = sel(stays, chance, f.refracts);
        color = sel3(stays, color, scale3(f.through, square(p.face.inv_eta)));
    }
    BsdfEval e;
    e.f = scale3(color, density * ggx_g1(i_up, p.alpha.x, p.alpha.y));
    e.pdf = p.facets * chance * density;
    BsdfEval above = principled_above(m, p, o, i_up, h, f);
    Mask is_above = stays & p.outside;
    e.f = sel3(is_above, add3(e.f, above.f), e.f);
    e.pdf = sel(is_above, e.pdf + above.pdf, e.pdf);
    return e;
}

FN BsdfEval bsdf_principled_eval(Material m, vec3 wo, vec3 wi) {
    Mask outside = wo.z > R(0.), usable = (wo.z != R(0.)) & (wi.z != R(0.));
    Real side = copysignR(R(1.), wo.z);
    vec3 up = v3(R(0.), R(0.), R(1.));
    vec3 o = sel3(usable, scale3(wo, side), up), i = sel3(usable, scale3(wi, side), up);
    Principled p = principled_at(m, o, outside);
    Mask stays = i.z > R(0.);
    vec3 half_vector = add3(o, i);
    if (HAS(spec_trans)) {
        usable = usable & (outside | (p.glass > R(0.)));
        half_vector = add3(o, scale3(i, sel(stays, R(1.), p.face.eta)));
    } else {
        usable = usable & outside & stays;
    }
    // Facets of an index of 1 turn no light: the half vector vanishes.
    Real squared = dot3(half_vector, half_vector);
    usable = usable & (squared > R(0.));
    vec3 h = scale3(half_vector, R(1.) / sqrtR(sel(usable, squared, R(1.))));
    h = scale3(h, copysignR(R(1.), h.z));
    Real ih = dot3(i, h);
    usable = usable & (dot3(o, h) > R(0.)) & (sel(stays, ih, -ih) > R(0.)) & (h.z > R(0.));
    i = sel3(usable, i, up);
    h = sel3(usable, h, normalize3(add3(o, up)));
    BsdfEval e = principled_value(m, p, o, i, h);
    e.f = sel3(usable, e.f, splat3(R(0.)));
    e.pdf = sel(usable, e.pdf, R(0.));
    return e;
}

/// A direction that a lobe chosen by u_lobe sends o to.
typedef struct {
    vec3 i, h; // h of what is spread means nothing
    Mask spreads, crosses;
} PrincipledDraw;

FN PrincipledDraw principled_draw(Material m, Principled p, vec3 o, vec2 u, Real u_lobe) {
    PrincipledDraw d;
    d.spreads = u_lobe < p.spreads;
    d.crosses = d.spreads & !d.spreads;
    Real before = p.spreads + p.coats;
    d.h = ggx_sample_visible(o, p.alpha.x, p.alpha.y, u);
    if (HAS(clearcoat)) d.h = sel3(u_lobe < before, gtr1_sample(clearcoat_alpha(m), u), d.h);
    Real cosine = dot3(o, d.h);
    d.i = reflect_about(o, d.h);
    if (HAS(spec_trans)) {
        Real c = sel(cosine > R(0.), cosine, R(1.));
        Facet f = principled_facet(m, p, c);
        d.crosses =
            (f.refracts > R(0.)) & (u_lobe >= before) & (u_lobe >= before + p.facets * f.mirrors);
        d.i = sel3(d.crosses, refract_about(o, d.h, c, f.fresnel.g, p.face), d.i);
    }
    // Normals of the coat may face away from o.
    d.i = sel3(cosine > R(0.), d.i, splat3(R(0.)));
    d.i = sel3(d.spreads, hemisphere_cosine(u), d.i);
    return d;
}

FN BsdfSample bsdf_principled_sample(Material m, vec3 wo, vec2 u, Real u_lobe) {
    BsdfSample s = bsdf_sample_none();
    Mask outside = wo.z > R(0.), usable = outside;
    Real side = copysignR(R(1.), wo.z);
    if (HAS(spec_trans)) usable = wo.z != R(0.);
    vec3 up = v3(R(0.), R(0.), R(1.));
    vec3 o = sel3(usable, scale3(wo, side), up);
    Principled p = principled_at(m, o, outside);
    if (HAS(spec_trans)) usable = usable & (outside | (p.glass > R(0.)));
    PrincipledDraw d = principled_draw(m, p, o, u, u_lobe);
    usable = usable & (sel(d.crosses, -d.i.z, d.i.z) > R(0.));
    vec3 i = sel3(usable, d.i, up);
    // Of a narrow lobe only the normal that was drawn tells where in it a direction lies.
    vec3 h = sel3(usable & !d.spreads, d.h, normalize3(add3(o, v3(i.x, i.y, absR(i.z)))));
    BsdfEval e = principled_value(m, p, o, i, h);
    usable = usable & (e.pdf > R(0.));
    s.wi = sel3(usable, scale3(i, side), s.wi);
    s.weight = sel3(usable, scale3(e.f, R(1.) / sel(usable, e.pdf, R(1.))), s.weight);
    s.pdf = sel(usable, e.pdf, R(0.));
    if (HAS(spec_trans)) s.eta = sel(usable & d.crosses, p.face.eta, R(1.));
    return s;
}
