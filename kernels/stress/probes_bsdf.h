// Probes of every kind of material in the list, each alone and through the dispatch.

FN ProbeOut out_eval(BsdfEval e) { return put1(out3(e.f), 3, e.pdf); }
FN ProbeOut out_sample(BsdfSample s) {
    return put1(put1(put3(out3(s.wi), 3, s.weight), 6, s.pdf), 7, s.eta);
}

#define BSDF_PROBE_FUNCTIONS(name, ...)                                                            \
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

/// A material of some energy tables, or none.
FN Material in_tabulated(ProbeIn i) {
    Material m = in_Material(i, 0);
    m.distribution = m.distribution | asInt((wordUint(i.w[16]) & 7u) << 1);
    return m;
}
FN ProbeOut probe_energy_place(ProbeIn i) {
    EnergyPlace p = energy_place(in_tabulated(i), in3(i, 17));
    return put2(out1(toReal(p.at)), 1, v2(p.along_cosine, p.along_azimuth));
}
FN ProbeOut probe_energy_gain(ProbeIn i) { return out3(energy_gain(in_tabulated(i), i.w[17])); }

#define BSDF_PROBES(name, ...) PROBE(name##_eval, "mdd", 4) PROBE(name##_sample, "mduuu", 8)
#define PROBES                                                                                     \
    MATERIALS(BSDF_PROBES)                                                                         \
    PROBE(any_bsdf_eval, "mdd", 4)                                                                 \
    PROBE(any_bsdf_sample, "mduuu", 8) PROBE(energy_place, "mbd", 3) PROBE(energy_gain, "mbc", 3)
