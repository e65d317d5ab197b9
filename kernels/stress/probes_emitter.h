// Probes of every kind of emitter in the list, each alone and through the dispatch.

FN ProbeOut out_emitter(EmitterSample s) {
    ProbeOut o = put1(put3(out3(s.wi), 3, s.weight), 6, s.inverse_pdf);
    o = put3(put3(put3(o, 7, s.q), 10, s.q_error), 13, s.q_normal);
    return put1(o, 16, mask_word(s.distant));
}

// The point that the second function asks about is one that the emitter itself chose.
#define EMITTER_PROBE_FUNCTIONS(name, ...)                                                         \
    FN ProbeOut probe_##name##_sample(ProbeIn i) {                                                 \
        return out_emitter(emitter_##name##_sample(in_Light(i, 0), in3(i, 16), in2(i, 19)));       \
    }                                                                                              \
    FN ProbeOut probe_##name##_hit(ProbeIn i) {                                                    \
        Light l = in_Light(i, 0);                                                                  \
        vec3 p = in3(i, 16);                                                                       \
        EmitterSample s = emitter_##name##_sample(l, p, in2(i, 19));                               \
        return out2(v2(emitter_##name##_pdf(l, p, s.wi, s.q),                                      \
                       mask_word(emitter_##name##_faces(l, s.wi, s.q))));                          \
    }
EMITTERS_BY_ROW(EMITTER_PROBE_FUNCTIONS)

FN ProbeOut probe_any_emitter_sample(ProbeIn i) {
    return out_emitter(emitter_sample(in_Light(i, 0), in3(i, 16), in2(i, 19)));
}
FN ProbeOut probe_any_emitter_hit(ProbeIn i) {
    Light l = in_Light(i, 0);
    vec3 p = in3(i, 16);
    EmitterSample s = emitter_sample(l, p, in2(i, 19));
    EmitterHit hit = emitter_hit(l, p, s.wi, s.q, p.x == p.x);
    return put1(out3(hit.radiance), 3, hit.pdf);
}

FN ProbeOut probe_light_importance(ProbeIn i) {
    LightImportance x = light_importance(in_LightNode(i, 0), in3(i, 16), in3(i, 19));
    return out2(v2(x.to_surface, x.to_point));
}

#define EMITTER_PROBES(name, ...) PROBE(name##_sample, "lpuu", 17) PROBE(name##_hit, "lpuu", 2)
#define PROBES                                                                                     \
    EMITTERS_BY_ROW(EMITTER_PROBES)                                                                \
    PROBE(any_emitter_sample, "lpuu", 17)                                                          \
    PROBE(any_emitter_hit, "lpuu", 4) PROBE(light_importance, "psdfsbbbbbbbpd", 2)
