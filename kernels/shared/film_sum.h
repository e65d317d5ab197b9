// What the film adds up: sums and variances that stay right over 1e9 samples of a pixel.
//
// Samples come in groups (FILM_SAMPLES): of a group sums are short, and what is added to the film
// is as seldom as that.

/// sum + v for a group: the rounding errors of a few additions may add up on their own. (Of many
/// they may not: a plain sum of them stops growing, as any does.)
FN TwoReal group_add(TwoReal sum, Real v) {
    TwoReal s = two_difference(sum.high, -v);
    return two_real(s.high, sum.low + s.low);
}

/// A group's sum joins those before it, within 2^-46 of the result where both have the same sign
/// (Joldes, Muller and Popescu 2017, algorithm 5: 3 u^2).
FN TwoReal film_sum(TwoReal sum, TwoReal group) {
    return two_add(sum, two_quick_sum(group.high, group.low));
}

/// How samples x of weights g spread, as the film keeps it; the sum of g is kept beside it.
typedef struct {
    TwoReal mean;   // sum of g x / sum of g
    TwoReal spread; // sum of g (x - mean)^2
} Spread;

/// The same of a group of samples, about any centre among them: d = x - centre.
typedef struct {
    Real weight; // sum of g
    Real centre;
    Real first, second; // sums of g d and g d^2
} GroupSpread;

/// A group joins those before it, whose weights add up to weight_before (Chan, Golub and LeVeque
/// 1979): everything that is added to the spread is positive, so nothing cancels, however small it
/// is beside the mean. A group of no weight changes nothing.
FN Spread spread_join(Spread s, Real weight_before, GroupSpread g) {
    Mask some = g.weight > R(0.);
    Real weight = sel(some, g.weight, R(1.));
    Real offset = g.first / weight; // of the group's mean from its centre
    // About its own mean; it cannot be negative but for rounding.
    Real inside = maxR(g.second - offset * g.first, R(0.));
    TwoReal apart = two_difference(g.centre, s.mean.high);
    apart = two_quick_sum(apart.high, apart.low + (offset - s.mean.low));
    Real share = weight / (weight_before + weight);
    Real between = square(apart.high) * (weight_before * share);
    TwoReal mean = two_add(s.mean, two_multiply(apart, two_real(share, R(0.))));
    TwoReal spread = film_sum(s.spread, two_real(inside + between, R(0.)));
    Spread r;
    r.mean = two_real(sel(some, mean.high, s.mean.high), sel(some, mean.low, s.mean.low));
    r.spread = two_real(sel(some, spread.high, s.spread.high), sel(some, spread.low, s.spread.low));
    return r;
}
