// Probes of every kind of material in the list, each alone and through the dispatch.

FN ProbeOut out_eval(BsdfEval e) { return put1(out3(e.f), 3, e.pdf); }
FN ProbeOut out_sample(BsdfSample s) {
    return put1(put1(put3(out3(s.wi), 3, s.weight), 6, s.pdf), 7, s.eta);
}

#define BSDF_PROBE_FUNCTIONS(name, sides)                                                          \
    FN ProbeOut probe_##name##_eval(ProbeIn i) {                                                   \
        return out_eval(bsdf_##name##_eval(in_Material(i, 0), in3(i, 16), in3(i, 19)));            \
    }                                                                                              \
    FN ProbeOut probe_##name##_sample(ProbeIn i) {                                                 \
        return out_sample(                                                                         \
            bsdf_##name##_sample(in_Material(i, 0), in3(i, 16), in2(i, 19), i.w[21]));             \
    }
MATERIALS(BSDF_PROBE_FUNCTIONS)

FN ProbeOut probe_any_bsdf_eval(ProbeIn i) {
    return out_eval(bsdf_eval(in_Material(i, 0), in3(i, 16), in3(i, 19)));
}
FN ProbeOut probe_any_bsdf_sample(ProbeIn i) {
    return out_sample(bsdf_sample(in_Material(i, 0), in3(i, 16), in2(i, 19), i.w[21]));
}

#define BSDF_PROBES(name, sides) PROBE(name##_eval, "mdd", 4) PROBE(name##_sample, "mduuu", 8)
#define PROBES                                                                                     \
    MATERIALS(BSDF_PROBES) PROBE(any_bsdf_eval, "mdd", 4) PROBE(any_bsdf_sample, "mduuu", 8)
