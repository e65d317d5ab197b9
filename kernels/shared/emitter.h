// Dispatch to the kind of each lane's light, made from the list of emitters; and the weights that
// combine two strategies.

FN EmitterSample sel_emitter(Mask m, EmitterSample a, EmitterSample b) {
    EmitterSample s;
    s.wi = sel3(m, a.wi, b.wi);
    s.weight = sel3(m, a.weight, b.weight);
    s.inverse_pdf = sel(m, a.inverse_pdf, b.inverse_pdf);
    s.q = sel3(m, a.q, b.q);
    s.q_error = sel3(m, a.q_error, b.q_error);
    s.q_normal = sel3(m, a.q_normal, b.q_normal);
    s.distant = (m & a.distant) | ((!m) & b.distant);
    return s;
}

FN EmitterSample emitter_sample(Light l, vec3 p, vec2 u) {
    EmitterSample result = emitter_sample_none();
#define EMITTER_SAMPLE_CASE(name, ...)                                                             \
    if (HAS(emitter_##name)) {                                                                     \
        Mask mine = l.kind == emitter_##name;                                                      \
        if (someLane(mine)) result = sel_emitter(mine, emitter_##name##_sample(l, p, u), result);  \
    }
    EMITTERS_BY_ROW(EMITTER_SAMPLE_CASE)
    return result;
}

typedef struct {
    vec3 radiance; // along -wi; 0 from the dark side
    Real pdf;      // with which emitter_sample would have chosen wi; 0 where that is not asked for
} EmitterHit;

/// What a ray from p along wi sees of the light it hit at q; `weighted` lanes ask for the density.
FN EmitterHit emitter_hit(Light l, vec3 p, vec3 wi, vec3 q, Mask weighted) {
    EmitterHit hit;
    hit.radiance = splat3(R(0.));
    hit.pdf = R(0.);
#define EMITTER_HIT_CASE(name, place)                                                              \
    if (place_##place != place_nowhere && HAS(emitter_##name)) {                                   \
        Mask mine = l.kind == emitter_##name;                                                      \
        if (someLane(mine)) {                                                                      \
            Mask bright = mine & emitter_##name##_faces(l, wi, q);                                 \
            hit.radiance = sel3(bright, light_radiance(l), hit.radiance);                          \
            if (someLane(bright & weighted))                                                       \
                hit.pdf = sel(bright & weighted, emitter_##name##_pdf(l, p, wi, q), hit.pdf);      \
        }                                                                                          \
    }
    EMITTERS_BY_ROW(EMITTER_HIT_CASE)
    return hit;
}

/// Power heuristic with exponent 2 (Veach 1997, section 9.2) for a sample drawn with density `own`.
/// Never squares a density; an infinite density (delta lobe or light) takes all the weight.
FN Real power_heuristic(Real own, Real other) {
    Mask all = !finiteR(own) | (other == R(0.));
    Real ratio = other / sel(all, R(1.), own);
    return sel(all, R(1.), R(1.) / (R(1.) + ratio * ratio));
}

/// The same of 1 / own.
FN Real power_heuristic_inverse(Real inverse_own, Real other) {
    Real ratio = other * inverse_own;
    return R(1.) / (R(1.) + ratio * ratio);
}
