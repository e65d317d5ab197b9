// The sun, and the clear sky about it by the formula of Hosek and Wilkie 2012, "An analytic model
// for full spectral sky-dome radiance": in the sky's own frame, whose y is up. a, b, c: the frame's
// axes in world space (orthonormal), rgb: what the words of device/buffers.h (DAYLIGHT_*) are
// multiplied by. Nothing shines from below the horizon.
//
// Directions are chosen within the sun's cone, uniformly, or by the table of an image of the sky
// (device/daylight.h): as many of 256 as the words say.

/// A direction as the formula knows it.
typedef struct {
    Real up;            // cosine of the angle from the zenith
    Real chord_squared; // of the straight way to the sun on the unit sphere: 2 - 2 cosine
    Real angle;         // from the sun
} DaylightPlace;

/// By differences, which keep their digits near the sun. Both are unit vectors.
FN DaylightPlace daylight_place(vec3 w, vec3 sun) {
    vec3 apart = sub3(w, sun);
    DaylightPlace p;
    p.up = w.y;
    p.chord_squared = dot3(apart, apart);
    p.angle = 2.f * atan2R(sqrtR(p.chord_squared), length3(add3(w, sun)));
    return p;
}

/// Of one colour, what DAYLIGHT_SKY_FIELDS lists.
typedef struct {
    Real a, b, c, d, e, f, g, i, h, radiance;
} SkyFormula;

/// Radiance above the horizon. The hundredth is the formula's own. b is less than 0.
FN Real sky_formula(SkyFormula k, DaylightPlace p) {
    Real up = maxR(p.up, R(0.));
    Real cosine = R(1.) - R(.5) * p.chord_squared, squared = cosine * cosine;
    Real power = k.e * p.angle, falling = exp_negative(-absR(power));
    Real glow = sel(power > R(0.), R(1.) / falling, falling);
    Real from_one = R(1.) - k.h, base = from_one * from_one + k.h * p.chord_squared;
    Real aureole = (R(1.) + squared) / (base * sqrtR(base));
    Real horizon = R(1.) + k.a * exp_negative(k.b / (up + R(.01)));
    return horizon * (k.c + k.d * glow + k.f * squared + k.g * aureole + k.i * sqrtR(up)) *
           k.radiance;
}

/// A direction within the cone about the sun, whose edge lies that far from the axis, uniformly.
FN vec3 sun_direction(vec3 sun, Real edge_chord_squared, vec2 u) {
    Real lost = R(.5) * edge_chord_squared * u.x; // 1 - cosine from the axis
    Real sine = sqrtR(lost * (R(2.) - lost));
    SinCos phi = sincos_turns(u.y);
    vec3 w = to_world(frame_from_normal(sun), v3(sine * phi.cosine, sine * phi.sine, -lost));
    return add3(sun, w);
}
