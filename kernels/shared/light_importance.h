// How much light a group of lights may send to a point: what a choice between two groups goes by.

/// Importance of a node of the light tree for a surface at p with the unit normal n, after Conty
/// Estevez and Kulla 2018, "Importance Sampling of Many Lights with Adaptive Tree Splitting": their
/// cos(max(0, angle - spread)) is replaced by its bound min(1, cos(angle) + sin(spread)), which is
/// positive wherever it is and needs no square roots. Zero only where no light of the group can
/// shine on p.
typedef struct {
    Real to_surface; // with the cosine at the surface, which faces n or -n
    Real to_point;   // without
} LightImportance;

FN LightImportance light_importance(LightNode node, vec3 p, vec3 n) {
    vec3 to = sub3(p, v3(node.cx, node.cy, node.cz));
    Real to_squared = dot3(to, to), radius_squared = node.radius * node.radius;
    Mask outside = to_squared > radius_squared;
    Real distance_squared = sel(outside, to_squared, radius_squared);
    // Cosines and sines are multiplied by the distance: the root need not wait for the division.
    Real distance = sqrtR(distance_squared), inverse_squared = R(1.) / distance_squared;
    // Sine of the half angle under which the group's sphere is seen; any angle from inside.
    Real seen = sel(outside, node.radius, 2.f * node.radius);
    Real cos_axis = dot3(to, v3(node.ax, node.ay, node.az));
    Real facing = minR(maxR(cos_axis + node.spread * distance + seen, R(0.)), distance);
    Real surface = minR(absR(dot3(to, n)) + seen, distance);
    Real brightness = node.intensity * inverse_squared;
    Mask fixed = node.fixed != 0;
    // Of a point light at p itself nothing is seen: the inverse of its distance is no number's.
    Mask dark = !finiteR(brightness);
    LightImportance i;
    i.to_point = brightness * (facing * distance * inverse_squared);
    i.to_surface = brightness * (facing * surface * inverse_squared);
    i.to_point = sel(fixed, node.intensity, sel(dark, R(0.), i.to_point));
    i.to_surface = sel(fixed, node.intensity, sel(dark, R(0.), i.to_surface));
    return i;
}
