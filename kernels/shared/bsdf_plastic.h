// A matte base under a smooth dielectric coat, which reflects light back at the base, too: all
// orders summed, as in Mitsuba 3. Light that the coat lets in and out again is spread by the base.

/// How a direction is drawn.
typedef struct {
    Real mirrors; // the chance that it is one that the coat reflects to
    Real spreads; // and that it is one of the base's
} CoatChances;

/// By what either is worth to light that comes from everywhere.
FN CoatChances coat_chances(Material m, Real reflectance, Real transmittance) {
    Real coloured = mean_component(material_transmittance(m)),
         base = mean_component(material_reflectance(m));
    Real mirrors = reflectance * coloured, spreads = transmittance * base;
    Real scale = R(1.) / sel(mirrors + spreads > R(0.), mirrors + spreads, R(1.));
    CoatChances c;
    c.mirrors = mirrors * scale;
    c.spreads = spreads * scale;
    return c;
}

/// What the coat does with light from or to a direction of cosine c, and how a direction is drawn.
typedef struct {
    Fresnel fresnel;
    CoatChances chances;
} Coat;

FN Coat coat_at(Material m, Real c) {
    Coat coat;
    coat.fresnel = fresnel_dielectric(c, material_interface(m, c == c));
    coat.chances = coat_chances(m, coat.fresnel.reflectance, coat.fresnel.transmittance);
    return coat;
}

/// f pi of the base below a coat of index 1 / inv_eta for light that is let in and out: what the
/// coat sends back to it is reflected again, tinted each time if `nonlinear` (types.h: kg).
FN vec3 coated_reflectance(Material m, Real inv_eta) {
    vec3 base = material_reflectance(m);
    Real back = absR(m.kg), inner = square(inv_eta);
    vec3 again = sel3(m.kg < R(0.), scale3(base, back), splat3(back));
    return v3(inner * base.x / (R(1.) - again.x), inner * base.y / (R(1.) - again.y),
              inner * base.z / (R(1.) - again.z));
}

FN BsdfEval bsdf_plastic_eval(Material m, vec3 wo, vec3 wi) {
    Mask reflects = (wo.z > R(0.)) & (wi.z > R(0.));
    Coat out = coat_at(m, sel(reflects, wo.z, R(1.)));
    Fresnel in =
        fresnel_dielectric(sel(reflects, wi.z, R(1.)), material_interface(m, wi.z == wi.z));
    Real spread = wi.z * R(INV_PI);
    BsdfEval e;
    e.pdf = sel(reflects, out.chances.spreads * spread, R(0.));
    Real value = out.fresnel.transmittance * in.transmittance * spread;
    e.f = sel3(reflects, scale3(coated_reflectance(m, m.eg), value), splat3(R(0.)));
    return e;
}

FN BsdfSample bsdf_plastic_sample(Material m, vec3 wo, vec2 u, Real u_lobe) {
    BsdfSample s = bsdf_sample_none();
    Mask front = wo.z > R(0.);
    Coat out = coat_at(m, sel(front, wo.z, R(1.)));
    Mask mirrors = front & (u_lobe < out.chances.mirrors),
         spreads = front & !mirrors & (out.chances.spreads > R(0.));
    vec3 spread = hemisphere_cosine(u);
    Fresnel in = fresnel_dielectric(spread.z, material_interface(m, front | !front));
    Real chance = sel(mirrors, out.chances.mirrors, sel(spreads, out.chances.spreads, R(1.)));
    vec3 mirrored = scale3(material_transmittance(m), out.fresnel.reflectance / chance);
    Real let_through = out.fresnel.transmittance * in.transmittance / chance;
    s.wi = sel3(mirrors, reflect_local(wo), sel3(spreads, spread, s.wi));
    s.weight = sel3(spreads, scale3(coated_reflectance(m, m.eg), let_through), s.weight);
    s.weight = sel3(mirrors, mirrored, s.weight);
    s.pdf = sel(spreads, out.chances.spreads * spread.z * R(INV_PI), s.pdf);
    s.pdf = sel(mirrors, LANE_INFINITY, s.pdf);
    return s;
}
