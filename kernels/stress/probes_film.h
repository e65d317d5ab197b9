// Probes of the film's sums and spreads.
FN ProbeOut put_two(ProbeOut o, int at, TwoReal v) {
    return put1(put1(o, at, v.high), at + 1, v.low);
}
FN TwoReal in_two(ProbeIn i, int at) { return two_quick_sum(i.w[at], i.w[at + 1]); }

FN ProbeOut probe_group_add(ProbeIn i) {
    return put_two(no_output(), 0, group_add(two_real(i.w[0], i.w[1]), i.w[2]));
}
FN ProbeOut probe_film_sum(ProbeIn i) {
    return put_two(no_output(), 0, film_sum(in_two(i, 0), two_real(i.w[2], i.w[3])));
}
FN ProbeOut probe_spread_join(ProbeIn i) {
    Spread before;
    before.mean = in_two(i, 0);
    before.spread = two_real(i.w[2], R(0.));
    GroupSpread g;
    g.weight = i.w[4];
    g.centre = i.w[5];
    g.first = i.w[6];
    g.second = i.w[7];
    Spread s = spread_join(before, i.w[3], g);
    return put_two(put_two(no_output(), 0, s.mean), 2, s.spread);
}

// The list below is a table.
// clang-format off
#define PROBES                                                                                     \
    PROBE(group_add, "rrr", 2) PROBE(film_sum, "ffff", 2) PROBE(spread_join, "fcssscrs", 4)
