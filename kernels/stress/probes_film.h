// Probes of the film's sums and spreads.
FN ProbeOut put_two(ProbeOut o, int at, TwoReal v) {
    return put1(put1(o, at, v.high), at + 1, v.low);
}

FN ProbeOut probe_group_add(ProbeIn i) {
    return put_two(no_output(), 0, group_add(two_real(i.w[0], i.w[1]), i.w[2]));
}
/// A digit of a single, and of the sum of another digit with it.
FN ProbeOut probe_exact_digit(ProbeIn i) {
    ExactPart part = exact_part(i.w[0]);
    ExactDigit sum = exact_digit(part, 4, significand(i.w[1]) << 8u, (Uint)0u);
    ProbeOut o = put1(put1(no_output(), 0, toReal(part.word)), 1,
                      mask_word(exact_goes_on(part, 4, sum.carry)));
    o = put1(put1(o, 2, toReal(asInt(part.low >> 16u))), 3, toReal(asInt(part.low & 0xffffu)));
    return put1(put1(o, 4, toReal(asInt(sum.digit >> 16u))), 5, toReal(asInt(sum.digit & 0xffffu)));
}
FN ProbeOut probe_spread_terms(ProbeIn i) {
    GroupSpread g;
    g.weight = i.w[0];
    g.centre = i.w[1];
    g.first = i.w[2];
    g.second = i.w[3];
    SpreadTerms t = spread_terms(g);
    ProbeOut o = no_output();
    for (int k = 0; k < SPREAD_TERMS_FIRST; k++)
        o = put1(o, k, t.first[k]);
    for (int k = 0; k < SPREAD_TERMS_SECOND; k++)
        o = put1(o, SPREAD_TERMS_FIRST + k, t.second[k]);
    return o;
}

// The list below is a table.
// clang-format off
#define PROBES                                                                                     \
    PROBE(group_add, "rrr", 2) PROBE(exact_digit, "ff", 6) PROBE(spread_terms, "scrs", 10)
