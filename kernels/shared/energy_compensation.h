// Light that a rough surface scatters more than once before it leaves, which a microfacet lobe of
// single scattering loses: the lobe is scaled so that what arrives is sent on (Turquin 2019,
// "Practical multiple scattering compensation for microfacet models").
//
// E(wo), the share of single scattering, stands in a table for each roughness (and index), made in
// double by the host. The scale depends on wo alone, so that lobes lose their reciprocity by it.

/// First of the material's tables; -1: it has none. An interface has two, seen from outside and
/// from inside; a rough coat too: the share that it sends on (1 where it is not scaled), and of
/// that, the share that it lets through.
FN Int energy_table(Material m) { return (m.distribution >> 1) - 1; }

/// Whether what single scattering sends on is in part refracted.
FN Mask scatters_both_ways(Material m) {
    Mask both = m.kind == material_roughdielectric;
    if (HAS(bsdf_roughplastic)) both = both | (m.kind == material_roughplastic);
    return both;
}

/// What E(wo) is interpolated from: the entries at `at` and behind it; where lobes are anisotropic
/// also those ENERGY_COSINES further. The parts of the way from the first to the second.
typedef struct {
    Int at;
    Real along_cosine, along_azimuth;
} EnergyPlace;

/// |sin(azimuth)|^2 of wo about the normal, 0 at the normal itself.
FN Real azimuth_sine_squared(vec3 wo) {
    Real x = wo.x * wo.x, y = wo.y * wo.y;
    Mask leans = x + y > R(0.);
    return sel(leans, y / sel(leans, x + y, R(1.)), R(0.));
}

/// Square of the roughness in the plane of wo and the normal.
FN Real roughness_along(Real sine_squared, Real alpha_u, Real alpha_v) {
    return alpha_u * alpha_u * (R(1.) - sine_squared) + alpha_v * alpha_v * sine_squared;
}

/// The cosine p / s below which E changes most.
typedef struct {
    Real p, s;
} EnergyScale;

/// The roughness; of an interface about the smaller of that and eta^2 - 1, as light that grazes
/// equal indices is all but lost. Of a coat, which changes towards grazing angles even if it is
/// smooth, not much less than LEAST_COAT_SCALE.
#define LEAST_COAT_SCALE .002
FN EnergyScale energy_scale(Material m, Real alpha) {
    if (HAS(bsdf_roughplastic))
        alpha = sel(m.kind == material_roughplastic, alpha + R(LEAST_COAT_SCALE), alpha);
    Mask interface = scatters_both_ways(m);
    Real contrast = absR(m.eb);
    EnergyScale a;
    a.p = sel(interface, alpha * contrast, alpha);
    a.s = sel(interface, alpha + contrast, R(1.));
    return a;
}

/// In [0, 1] for a cosine c: half of the interval in proportion to it, half to c (1 + a)/(c + a).
FN Real energy_cosine_coordinate(Real c, EnergyScale a) {
    return .5f * c * ((a.s + a.p) / (c * a.s + a.p) + 1.f);
}

/// In [0, 1] for an azimuth: half of the interval by the surface, half as the slopes see it.
FN Real energy_azimuth_coordinate(Real sine_squared, Real alpha_u, Real alpha_v) {
    Real along_v = alpha_v * alpha_v * sine_squared;
    return .5f * (sine_squared + along_v / roughness_along(sine_squared, alpha_u, alpha_v));
}

/// In which of `count` intervals of [0, 1] x lies; in bounds for any x, also for one of no number.
FN Int interval_of(Real x, int count) {
    Real scaled = x * (float)count;
    Mask inside = (scaled > R(0.)) & (scaled < (float)count);
    Int i = toInt(sel(inside, scaled, R(0.)));
    return sel(scaled >= (float)count, (Int)(count - 1), i);
}

FN EnergyPlace energy_place(Material m, vec3 wo) {
    Real alpha = m.alpha_u, sine_squared = R(0.);
    if (HAS(anisotropy)) {
        sine_squared = azimuth_sine_squared(wo);
        alpha = sqrtR(roughness_along(sine_squared, m.alpha_u, m.alpha_v));
    }
    Real cosine = energy_cosine_coordinate(absR(wo.z), energy_scale(m, alpha));
    Int column = interval_of(cosine, ENERGY_COSINES - 1);
    Mask from_inside = (m.kind == material_roughdielectric) & (wo.z < R(0.));
    Int table = energy_table(m) + sel(from_inside, (Int)1, (Int)0);
    EnergyPlace place;
    place.at = sel(energy_table(m) >= 0, table, (Int)0) * ENERGY_TABLE_SIZE + column;
    place.along_cosine = cosine * (float)(ENERGY_COSINES - 1) - toReal(column);
    place.along_azimuth = R(0.);
    if (HAS(anisotropy)) {
        Real azimuth = energy_azimuth_coordinate(sine_squared, m.alpha_u, m.alpha_v);
        Int row = interval_of(azimuth, ENERGY_AZIMUTHS - 1);
        place.at = place.at + row * ENERGY_COSINES;
        place.along_azimuth = azimuth * (float)(ENERGY_AZIMUTHS - 1) - toReal(row);
    }
    return place;
}

/// What lobes of the material are scaled by, where E(wo) is `energy`. An interface, a coat's too,
/// sends on all it receives, by 1/E. A metal sends on F <F>^n of what it scatters n times more: 1 +
/// <F> (1 - E)/E, <F> being its average reflectance, which its record keeps in place of a
/// transmittance.
FN vec3 energy_gain(Material m, Real energy) {
    Real inverse = R(1.) / energy, lost = inverse - 1.f;
    vec3 again = material_transmittance(m);
    vec3 metal = v3(R(1.) + again.x * lost, R(1.) + again.y * lost, R(1.) + again.z * lost);
    return sel3(scatters_both_ways(m), splat3(inverse), metal);
}
