// Normals that a texture tilts, as Mitsuba 3.9 does: all in the frame of the surface, turned over
// to be seen from above where its material is opaque.

/// The normal of a surface whose derivatives along u and v rise by `slope` more than du and dv do;
/// of some length, upwards.
FN vec3 normal_of_heights(vec3 du, vec3 dv, vec2 slope) {
    Real area = du.x * dv.y - du.y * dv.x;
    vec3 n = v3(du.y * slope.y - slope.x * dv.y, slope.x * dv.x - du.x * slope.y, area);
    // Where u and v do not span the surface, nothing is known of its slopes.
    Mask spans = area != R(0.);
    return sel3(spans, scale3(n, copysignR(R(1.), area)), v3(R(0.), R(0.), R(1.)));
}

/// The frame about normal n of any length, along the surface's. Where `flips` and n is turned away
/// from the viewer at wo, n is mirrored about the surface's normal first (Schuessler et al. 2017).
FN ShadingFrame tilted_frame(vec3 n, vec3 wo, Mask flips) {
    Mask away = flips & (wo.z * dot3(wo, n) <= R(0.));
    n = sel3(away, v3(-n.x, -n.y, n.z), n);
    Real squared = dot3(n, n);
    Mask usable = (squared > R(0.)) & finiteR(squared); // steeper is no slope
    n = sel3(usable, scale3(n, R(1.) / sqrtR(sel(usable, squared, R(1.)))),
             v3(R(0.), R(0.), R(1.)));
    return frame_from_tangent(n, v3(R(1.), R(0.), R(0.)));
}

/// Of light from or to w the share that other facets, tilted as much as n, let through (Conty
/// Estevez, Lecocq and Stein 2019, "A microfacet-based shadowing function to solve the bump
/// terminator problem").
FN Real facets_shadow(vec3 n, vec3 w) {
    Real across = R(.125) * (n.x * n.x + n.y * n.y), along = n.z * n.z;
    Mask steep = across >= along;
    Real alpha_squared = sel(steep, R(1.), across / sel(steep, R(1.), along));
    Real z = absR(w.z);
    Real stretched = sqrtR(z * z + alpha_squared * (w.x * w.x + w.y * w.y));
    Mask level = z + stretched <= R(0.);
    return sel(level, R(0.), R(2.) * z / sel(level, R(1.), z + stretched));
}

/// Whether a direction is on the same side of the surface as it is of the tilted one.
FN Mask tilted_with(vec3 in_surface, vec3 in_tilted) { return in_surface.z * in_tilted.z > R(0.); }
