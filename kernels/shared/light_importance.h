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
    Real distance_squared = dot3(to, to);
    Mask outside = distance_squared > node.radius * node.radius;
    Real inverse = R(1.) / sqrtR(sel(outside, distance_squared, node.radius * node.radius));
    // Sine of the half angle under which the group's sphere is seen; any angle from inside.
    Real sin_seen = sel(outside, node.radius * inverse, R(2.));
    Real cos_axis = dot3(to, v3(node.ax, node.ay, node.az)) * inverse;
    Real cos_surface = absR(dot3(to, n)) * inverse;
    Real facing = minR(maxR(cos_axis + node.spread + sin_seen, R(0.)), R(1.));
    Real most = node.intensity * facing * inverse * inverse;
    Mask fixed = node.fixed != 0;
    // Of a point light at p itself nothing is seen: the inverse of its distance is no number's.
    Mask at_the_light = !finiteR(most);
    most = sel(fixed, node.intensity, sel(at_the_light, R(0.), most));
    LightImportance i;
    i.to_point = most;
    i.to_surface = sel(fixed, most, most * minR(cos_surface + sin_seen, R(1.)));
    i.to_surface = sel(at_the_light & !fixed, R(0.), i.to_surface);
    return i;
}
