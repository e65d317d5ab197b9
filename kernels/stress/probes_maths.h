// Probes of vectors, elementary functions, the sampler, warps, frames, Fresnel and microfacets. A
// letter stands for what its input words hold: tests/support/probe_inputs.h says what.

FN ProbeOut probe_cross3(ProbeIn i) { return out3(cross3(in3(i, 0), in3(i, 3))); }
FN ProbeOut probe_vectors(ProbeIn i) {
    vec3 a = in3(i, 0), b = in3(i, 3);
    ProbeOut o = put3(no_output(), 0, normalize3(a));
    o = put1(put1(o, 3, dot3(a, b)), 4, length3(b));
    o = put1(put1(o, 5, max_component(a)), 6, sqrt_nonnegative(b.x));
    o = put1(put1(o, 7, difference_of_products(a.x, a.y, b.x, b.y)), 8, mask_word(finite3(a)));
    return put1(put1(o, 9, copysignR(a.x, b.x)), 10, absR(a.x));
}
FN ProbeOut probe_neighbours(ProbeIn i) {
    Real x = i.w[0], way = i.w[1];
    ProbeOut o = out3(v3(nextUp(x), nextDown(x), nextAlong(x, way)));
    // From zero, and along nothing.
    return put3(o, 3, v3(nextAlong(R(0.), way), nextAlong(R(-0.), way), nextAlong(x, way * R(0.))));
}
FN ProbeOut probe_sincos_turns(ProbeIn i) {
    SinCos s = sincos_turns(i.w[0]);
    return out2(v2(s.sine, s.cosine));
}
FN ProbeOut probe_exp_negative(ProbeIn i) { return out1(exp_negative(-i.w[0])); }
FN ProbeOut probe_atan2(ProbeIn i) { return out1(atan2R(i.w[0], i.w[1])); }
FN ProbeOut probe_acos(ProbeIn i) { return out2(v2(acosR(i.w[0]), acosR(-i.w[0]))); }

/// Four numbers, and the integers themselves in halves: a word that happens to be no number has no
/// bits of its own.
FN ProbeOut out_random4(Random4 r) {
    ProbeOut o = put2(no_output(), 0, uniform2(r.x, r.y));
    o = put2(o, 2, uniform2(r.z, r.w));
    o = put2(put2(o, 4, v2(toReal(asInt(r.x & 0xffffu)), toReal(asInt(r.x >> 16)))), 6,
             v2(toReal(asInt(r.y & 0xffffu)), toReal(asInt(r.y >> 16))));
    return put2(put2(o, 8, v2(toReal(asInt(r.z & 0xffffu)), toReal(asInt(r.z >> 16)))), 10,
                v2(toReal(asInt(r.w & 0xffffu)), toReal(asInt(r.w >> 16))));
}
FN ProbeOut probe_random4(ProbeIn i) {
    return out_random4(
        random4(wordUint(i.w[0]), wordUint(i.w[1]), wordUint(i.w[2]), wordUint(i.w[3])));
}
FN ProbeOut probe_faure4(ProbeIn i) {
    // With replicates: a pattern of 8.
    return out_random4(faure4(
        sample_number(wordUint(i.w[0]), wordUint(i.w[1]), wordUint(i.w[3]), 3), wordUint(i.w[2])));
}
FN ProbeOut probe_disk_uniform(ProbeIn i) { return out2(disk_uniform(in2(i, 0))); }
FN ProbeOut probe_hemisphere_cosine(ProbeIn i) { return out3(hemisphere_cosine(in2(i, 0))); }
FN ProbeOut probe_sphere_uniform(ProbeIn i) { return out3(sphere_uniform(in2(i, 0))); }
FN ProbeOut probe_triangle_uniform(ProbeIn i) { return out2(triangle_uniform(in2(i, 0))); }

FN ProbeOut probe_frame(ProbeIn i) {
    ShadingFrame f = frame_from_normal(in3(i, 0));
    ProbeOut o = put3(put3(put3(no_output(), 0, f.s), 3, f.t), 6, f.n);
    return put3(put3(o, 9, to_local(f, in3(i, 3))), 12, to_world(f, in3(i, 3)));
}
FN ProbeOut probe_frame_from_tangent(ProbeIn i) {
    ShadingFrame f = frame_from_tangent(in3(i, 0), in3(i, 3));
    return put3(put3(put3(no_output(), 0, f.s), 3, f.t), 6, f.n);
}
FN ProbeOut probe_reflect(ProbeIn i) {
    return put3(out3(reflect_local(in3(i, 0))), 3, reflect_about(in3(i, 0), in3(i, 3)));
}
FN ProbeOut probe_refract_local(ProbeIn i) {
    return out3(refract_local(in3(i, 0), in_interface(i, 3)));
}
FN ProbeOut probe_refract_about(ProbeIn i) {
    vec3 w = in3(i, 0), n = in3(i, 3);
    Real c = dot3(w, n);
    n = scale3(n, copysignR(R(1.), c));
    Interface face = in_interface(i, 6);
    Fresnel f = fresnel_dielectric(absR(c), face);
    return out3(refract_about(w, n, absR(c), f.g, face));
}
FN ProbeOut probe_fresnel_dielectric(ProbeIn i) {
    Fresnel f = fresnel_dielectric(i.w[0], in_interface(i, 1));
    return out3(v3(f.reflectance, f.transmittance, f.g));
}
FN ProbeOut probe_fresnel_conductor(ProbeIn i) {
    return out1(fresnel_conductor(i.w[0], i.w[1], i.w[2]));
}

FN ProbeOut probe_ggx(ProbeIn i) {
    vec3 h = in3(i, 0);
    ProbeOut o = out2(v2(ggx_d(h, i.w[3], i.w[4]), ggx_g1(h, i.w[3], i.w[4])));
    return put1(o, 2, ggx_visible_d(h, in3(i, 5), i.w[3], i.w[4]));
}
FN ProbeOut probe_beckmann(ProbeIn i) {
    vec3 h = in3(i, 0);
    return out2(v2(beckmann_d(h, i.w[3], i.w[4]), beckmann_g1(h, i.w[3], i.w[4])));
}
FN ProbeOut probe_ggx_sample_visible(ProbeIn i) {
    vec3 wo = in3(i, 0);
    wo.z = absR(wo.z);
    return out3(ggx_sample_visible(wo, i.w[3], i.w[4], in2(i, 5)));
}
FN ProbeOut probe_beckmann_sample_visible(ProbeIn i) {
    vec3 wo = in3(i, 0);
    wo.z = absR(wo.z);
    vec3 h = beckmann_sample_visible(wo, i.w[3], i.w[4], in2(i, 5));
    ProbeOut o = put1(out3(h), 3, beckmann_sample_visible_d(wo, h, i.w[3], i.w[4]));
    return put1(o, 4, beckmann_masking_ratio(wo, i.w[3], i.w[4]));
}
FN ProbeOut probe_power_heuristic(ProbeIn i) {
    return out3(v3(power_heuristic(i.w[0], i.w[1]), power_heuristic_inverse(i.w[0], i.w[1]),
                   power_heuristic(i.w[1], i.w[0])));
}
FN ProbeOut probe_russian_roulette(ProbeIn i) {
    Roulette r = russian_roulette(abs3(in3(i, 0)), i.w[3], i.w[4]);
    return out2(v2(mask_word(r.alive), r.scale));
}

// The lists below are tables.
// clang-format off
#define PROBES                                                                                     \
    PROBE(cross3, "rrrrrr", 3)                                                                     \
    PROBE(vectors, "rrrrrr", 11)                                                                   \
    PROBE(neighbours, "ff", 6)                                                                      \
    PROBE(sincos_turns, "u", 2)                                                                    \
    PROBE(exp_negative, "s", 1) PROBE(atan2, "ff", 1) PROBE(acos, "c", 2)                          \
        PROBE(random4, "bbbb", 12) PROBE(faure4, "bbbb", 12) PROBE(disk_uniform, "uu", 2) PROBE(hemisphere_cosine, "uu", 3)  \
            PROBE(sphere_uniform, "uu", 3) PROBE(triangle_uniform, "uu", 2) PROBE(frame, "dp", 15) \
                PROBE(frame_from_tangent, "dp", 9) PROBE(reflect, "dd", 6)                         \
                    PROBE(refract_local, "di", 3) PROBE(refract_about, "ddi", 3)                   \
                        PROBE(fresnel_dielectric, "ci", 3) PROBE(fresnel_conductor, "css", 1)      \
                            PROBE(ggx, "daad", 3) PROBE(beckmann, "daa", 2)                         \
                                PROBE(ggx_sample_visible, "daauu", 3)                              \
                                PROBE(beckmann_sample_visible, "daauu", 5)                         \
                                    PROBE(power_heuristic, "rr", 3)                                \
                                        PROBE(russian_roulette, "rrrcu", 2)
