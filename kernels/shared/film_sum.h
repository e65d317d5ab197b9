// What a group of samples adds to the film (FILM_SAMPLES of them): of the groups of a pixel the
// film keeps sums without error (exact_sum.h), so that neither their number nor their order
// matters.

/// sum + v for a group: the rounding errors of a few additions may add up on their own.
FN TwoReal group_add(TwoReal sum, Real v) {
    TwoReal s = two_difference(sum.high, -v);
    return two_real(s.high, sum.low + s.low);
}

/// How the samples x of a group spread, g being the squares of their weights, about any centre
/// among them: d = x - centre.
typedef struct {
    Real weight; // sum of g
    Real centre;
    Real first, second; // sums of g d and g d^2
} GroupSpread;

#define SPREAD_TERMS_FIRST 3
#define SPREAD_TERMS_SECOND 7
/// Sums of g x and of g x^2, unevaluated: their terms add up to them without error,
///
///     sum of g x   = first + centre weight
///     sum of g x^2 = second + 2 centre first + centre^2 weight,
///
/// so that what is lost of a group's own sums is relative to how it spreads, not to how large its
/// values are.
typedef struct {
    Real first[SPREAD_TERMS_FIRST], second[SPREAD_TERMS_SECOND];
} SpreadTerms;

FN SpreadTerms spread_terms(GroupSpread g) {
    TwoReal moved = two_product(g.centre, g.weight),
            across = two_product(g.centre, g.first + g.first);
    TwoReal square = two_product(g.centre, g.centre);
    TwoReal high = two_product(square.high, g.weight), low = two_product(square.low, g.weight);
    SpreadTerms t;
    t.first[0] = g.first;
    t.first[1] = moved.high, t.first[2] = moved.low;
    t.second[0] = g.second;
    t.second[1] = across.high, t.second[2] = across.low;
    t.second[3] = high.high, t.second[4] = high.low;
    t.second[5] = low.high, t.second[6] = low.low;
    // Squares reach the end of single precision long before values do: what passes it is infinite
    // as a whole.
    Mask fits = finiteR(high.high) & finiteR(across.high) & finiteR(g.second);
    for (int k = 0; k < SPREAD_TERMS_FIRST; k++)
        t.first[k] = sel(fits, t.first[k], R(0.));
    for (int k = 0; k < SPREAD_TERMS_SECOND; k++)
        t.second[k] = sel(fits, t.second[k], k == 0 ? (Real)LANE_INFINITY : R(0.));
    return t;
}
