// A sphere that emits outward (`extra` +1) or inward (-1): centre a, radius bx.
//
// One that emits outward is seen from outside: directions are chosen uniformly in the cone it
// fills. One that emits inward is seen from inside: points are chosen uniformly by area. The choice
// goes by the side that emits, not by the distance of p: a point on its own wall rounds to either
// side, and both strategies must take the same branch.

typedef struct {
    Mask outside, visible;
    Real distance_squared; // from p to the centre
    Real power;            // distance_squared / radius^2 - 1
    Real sine_squared;     // of the cone's half angle
    Real one_minus_cosine;
} SphereCone;

FN SphereCone emitter_area_sphere_cone(Light l, vec3 p) {
    vec3 to = sub3(light_a(l), p);
    SphereCone c;
    c.distance_squared = dot3(to, to);
    Real radius_squared = l.bx * l.bx;
    c.outside = l.extra > R(0.);
    c.visible = !c.outside | (c.distance_squared > radius_squared);
    Mask cone = c.outside & c.visible;
    c.sine_squared = sel(cone, radius_squared / sel(cone, c.distance_squared, R(1.)), R(1.));
    c.power = sel(cone, (c.distance_squared - radius_squared) / radius_squared, R(0.));
    c.one_minus_cosine = c.sine_squared / (R(1.) + sqrtR(R(1.) - c.sine_squared));
    return c;
}

FN EmitterSample emitter_area_sphere_sample(Light l, vec3 p, vec2 u) {
    SphereCone cone = emitter_area_sphere_cone(l, p);
    vec3 centre = light_a(l);
    // Inside: a point uniform by area.
    vec3 outward = sphere_uniform(u);
    // Outside: a direction in the cone; the point it meets first lies at the angle alpha about the
    // centre, whose sine comes from the distance of that point: next to the sphere its cosine is 1.
    Real one_minus_c = u.x * cone.one_minus_cosine;
    Real c = R(1.) - one_minus_c;
    Real s_squared = one_minus_c * (R(1.) + c);
    Real ratio = s_squared / cone.sine_squared; // sin^2(theta) / sin^2(theta_max), in [0, 1)
    Real sine_max = sqrtR(cone.sine_squared);
    Real inside = sqrt_nonnegative(R(1.) - ratio); // half the ray's way through, over the radius
    Real cos_alpha = s_squared / sine_max + c * inside;
    Real sin_alpha = sqrtR(s_squared) * cone.power / (c / sine_max + inside);
    SinCos phi = sincos_turns(u.y);
    vec3 axis = sub3(p, centre);
    Mask in_cone = cone.outside & cone.visible;
    axis = scale3(axis, R(1.) / sqrtR(sel(in_cone, cone.distance_squared, R(1.))));
    axis = sel3(in_cone, axis, v3(R(0.), R(0.), R(1.)));
    vec3 toward = to_world(frame_from_normal(axis),
                           v3(sin_alpha * phi.cosine, sin_alpha * phi.sine, cos_alpha));
    outward = sel3(cone.outside, toward, outward);
    vec3 q = add3(centre, scale3(outward, l.bx));
    vec3 error = scale3(add3(abs3(centre), scale3(abs3(outward), l.bx)), GAMMA(7.f));
    EmitterSample by_area = emitter_area_finish(l, p, q, error, scale3(outward, l.extra));
    Real solid_angle = sel(cone.visible, R(TWO_PI) * cone.one_minus_cosine, R(0.));
    by_area.inverse_pdf =
        sel(cone.outside, solid_angle * light_inverse_pmf(l), by_area.inverse_pdf);
    by_area.weight = scale3(light_radiance(l), by_area.inverse_pdf);
    return by_area;
}

FN Real emitter_area_sphere_pdf(Light l, vec3 p, vec3 wi, vec3 q) {
    SphereCone cone = emitter_area_sphere_cone(l, p);
    vec3 outward = scale3(sub3(q, light_a(l)), R(1.) / l.bx);
    return sel(cone.outside, l.pmf * R(INV_TWO_PI) / cone.one_minus_cosine,
               emitter_area_pdf(l, p, q, outward));
}

FN Mask emitter_area_sphere_faces(Light l, vec3 wi, vec3 q) {
    return dot3(sub3(q, light_a(l)), wi) * l.extra < R(0.);
}
