// Shading normals that keep to the geometry: no light from below the surface, no mirror image into
// it, and, where it is asked for, a soft edge of the light on coarse meshes.

/// A unit normal n and the geometric normal on its side.
typedef struct {
    vec3 n, g;
} ShadingSide;

/// The least height of a mirrored direction over the surface, in heights of the viewer.
#define LEAST_MIRRORED_HEIGHT .25

/// The normal in the plane of the geometric normal g and the shading normal n about which the image
/// of the viewer wo is as high as it has to be; g where there is no such plane, and where rounding
/// would leave the viewer below.
///
/// With n = (cos a, sin a) and wo = r (cos b, sin b) in that plane, the image of wo is r (cos(2a -
/// b), ..). Its height is h at 2a = b + acos(h / r), and n is along (1 + cos 2a, sin 2a).
FN vec3 turned_normal(vec3 n, vec3 g, vec3 wo) {
    Real height = dot3(wo, g), least = height * R(LEAST_MIRRORED_HEIGHT);
    vec3 along = sub3(n, scale3(g, dot3(n, g)));
    Real along_squared = dot3(along, along);
    Mask differ = along_squared > R(0.);
    along = scale3(along, R(1.) / sqrtR(sel(differ, along_squared, R(1.))));
    Real across = dot3(wo, along);
    Real r_squared = height * height + across * across;
    Real s = sqrt_nonnegative(r_squared - least * least);
    // r^2 - across s without cancellation where they are near.
    Mask near = differ & (across > R(0.));
    Real quotient = (r_squared * height * height + square(across * least)) /
                    sel(near, r_squared + across * s, R(1.));
    Real up = height * least + sel(near, quotient, r_squared - across * s);
    vec3 turned = add3(scale3(g, up), scale3(along, across * least + height * s));
    Real length = length3(turned);
    turned = scale3(turned, R(1.) / sel(length > R(0.), length, R(1.)));
    return sel3(differ & (dot3(turned, wo) > R(0.)), turned, g);
}

/// The shading normal n, turned towards the geometric normal g as far as it takes for the viewer wo
/// and its mirror image to be above the surface (all of unit length; g . wo >= 0, g . n >= 0).
FN vec3 normal_that_mirrors_upwards(vec3 n, vec3 g, vec3 wo) {
    Real height = dot3(wo, g), mirrored = 2.f * dot3(wo, n) * dot3(n, g) - height;
    Mask low = mirrored < height * R(LEAST_MIRRORED_HEIGHT);
    if (someLane(low)) n = sel3(low, turned_normal(n, g, wo), n);
    return n;
}

/// For an interpolated normal ns, a geometric normal ng and the direction to the viewer: the normal
/// to shade with, on the side of ns.
FN ShadingSide shading_side(vec3 ns, vec3 ng, vec3 wo) {
    vec3 g = scale3(ng, copysignR(R(1.), dot3(ng, ns)));
    Real above = copysignR(R(1.), dot3(g, wo));
    ShadingSide s;
    s.g = g;
    s.n = scale3(normal_that_mirrors_upwards(scale3(ns, above), scale3(g, above), wo), above);
    return s;
}

/// Share of the light from or to wi that counts: none where the two normals see it on different
/// sides. Where wi is no number it counts, for the sample to be found.
FN Real consistent_share(ShadingSide s, vec3 wi) {
    return sel(dot3(s.n, wi) * dot3(s.g, wi) <= R(0.), R(0.), R(1.));
}

/// The same where the light of matte surfaces fades towards the horizon of the geometry (Chiang,
/// Li and Burley 2019, "Taming the shadow terminator"): at most 1, and 1 where the normals agree.
/// It hides the edges of faces, but takes the image further from that of the surface the mesh
/// stands for (docs/accuracy.md).
FN Real softened_share(ShadingSide s, vec3 wi) {
    Real geometric = dot3(s.g, wi), shading = dot3(s.n, wi) * dot3(s.n, s.g);
    Mask hidden = geometric * shading <= R(0.);
    Real ratio = minR(R(1.), geometric / sel(hidden, R(1.), shading));
    return sel(hidden, R(0.), ratio * (R(1.) + ratio * (R(1.) - ratio)));
}

/// Share of the light from or to wi that counts on this material.
FN Real counted_share(ShadingSide s, Material m, vec3 wi) {
    Real share = consistent_share(s, wi);
    if (HAS(soft_terminator)) {
        Mask matte = ((((Int)1) << m.kind) & MATTE_MATERIALS) != 0;
        share = sel(matte, softened_share(s, wi), share);
    }
    // No surface at all hides nothing.
    if (HAS(bsdf_null)) share = sel(m.kind == material_null, R(1.), share);
    return share;
}
