// A matte base and a glossy lobe that knows nothing of it: what materials of Mitsuba 0.x have in
// common. Their reflectances are what either is worth: a direction is drawn from either by them.

/// A lobe of reflectance 1, from the viewer to wi.
typedef struct {
    Real f; // f cos(wi)
    Real pdf;
} GlossyLobe;

/// Chances that a direction is the lobe's and that it is the base's; both 0 where both are black.
typedef struct {
    Real glossy, matte;
} GlossyChances;

FN GlossyChances glossy_chances(Material m) {
    Real glossy = mean_component(material_transmittance(m)),
         matte = mean_component(material_reflectance(m));
    Mask some = glossy + matte > R(0.);
    Real scale = R(1.) / sel(some, glossy + matte, R(1.));
    GlossyChances c;
    c.glossy = glossy * scale;
    c.matte = matte * scale;
    return c;
}

FN BsdfEval glossy_eval(Material m, Mask reflects, vec3 wi, GlossyLobe lobe) {
    GlossyChances c = glossy_chances(m);
    Real spread = wi.z * R(INV_PI);
    vec3 f =
        add3(scale3(material_transmittance(m), lobe.f), scale3(material_reflectance(m), spread));
    BsdfEval e;
    e.f = sel3(reflects, f, splat3(R(0.)));
    e.pdf = sel(reflects, c.glossy * lobe.pdf + c.matte * spread, R(0.));
    return e;
}

/// Of a direction that has been drawn.
FN BsdfSample glossy_sample(Material m, Mask reflects, vec3 wi, GlossyLobe lobe) {
    BsdfSample s = bsdf_sample_none();
    BsdfEval e = glossy_eval(m, reflects, wi, lobe);
    Mask scatters = e.pdf > R(0.);
    s.wi = sel3(scatters, wi, s.wi);
    s.weight = sel3(scatters, scale3(e.f, R(1.) / sel(scatters, e.pdf, R(1.))), s.weight);
    s.pdf = e.pdf;
    return s;
}
