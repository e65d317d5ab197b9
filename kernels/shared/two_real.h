// Sums of two Reals that are not added up: twice the digits, for the few signs that rounding must
// not decide.

/// The value is high + low; low is at most half a unit in the last place of high.
typedef struct {
    Real high, low;
} TwoReal;

typedef struct {
    TwoReal x, y, z;
} TwoReal3;

FN TwoReal two_real(Real high, Real low) {
    TwoReal r;
    r.high = high;
    r.low = low;
    return r;
}

/// a - b, exact (Knuth 1969: for any two numbers).
FN TwoReal two_difference(Real a, Real b) {
    Real high = a - b;
    Real minus_b = high - a;
    return two_real(high, (a - (high - minus_b)) - (b + minus_b));
}

/// The sum of a and b, where a is the larger in absolute value or of the same exponent (Dekker
/// 1971).
FN TwoReal two_quick_sum(Real a, Real b) {
    Real high = a + b;
    return two_real(high, b - (high - a));
}

/// a * b, exact unless it overflows or its low part is below the least normal number.
FN TwoReal two_product(Real a, Real b) {
    Real high = a * b;
    return two_real(high, fmaR(a, b, -high));
}

FN TwoReal two_scale(TwoReal a, Real power_of_two) {
    return two_real(a.high * power_of_two, a.low * power_of_two);
}

/// a * b - c * d, off by no more than 2^-43 (|a * b| + |c * d|).
///
/// With u = 2^-24, per product: the low parts' own product is left out (u^2) and three numbers of
/// up to u are rounded and added up (9 u^2); then the differences of the high parts, which is
/// exact, and of the low ones (6 u^2), and their sum (2 u^2).
FN TwoReal two_difference_of_products(TwoReal a, TwoReal b, TwoReal c, TwoReal d) {
    Real ab = a.high * b.high, cd = c.high * d.high;
    Real ab_low = fmaR(a.high, b.high, -ab) + (a.high * b.low + a.low * b.high);
    Real cd_low = fmaR(c.high, d.high, -cd) + (c.high * d.low + c.low * d.high);
    TwoReal difference = two_difference(ab, cd);
    return two_quick_sum(difference.high, difference.low + (ab_low - cd_low));
}

FN TwoReal two_add(TwoReal a, TwoReal b) {
    TwoReal sum = two_difference(a.high, -b.high);
    return two_quick_sum(sum.high, sum.low + (a.low + b.low));
}

FN TwoReal two_multiply(TwoReal a, TwoReal b) {
    Real high = a.high * b.high;
    return two_quick_sum(high, fmaR(a.high, b.high, -high) + (a.high * b.low + a.low * b.high));
}

/// a * b - c * d, its sign without error (but for what is below 2^-126): the sixteen parts of the
/// products, added up in rounds of additions without error (Ogita, Rump and Oishi 2005, "Accurate
/// sum and dot product"). A round makes what has not been added 2^-20 times as large or less.
FN_APART Real exact_difference_of_products(TwoReal a, TwoReal b, TwoReal c, TwoReal d) {
    Real part[16];
    Real first[4], second[4];
    first[0] = a.high, first[1] = a.low, first[2] = -c.high, first[3] = -c.low;
    second[0] = b.high, second[1] = b.low, second[2] = d.high, second[3] = d.low;
    for (int k = 0; k < 8; k++) {
        Real x = first[k / 2], y = second[k / 4 * 2 + k % 2];
        part[8 + k] = x * y;
        part[k] = fmaR(x, y, -part[8 + k]);
    }
    for (int round = 0; round < 8; round++)
        for (int k = 1; k < 16; k++) {
            TwoReal sum = two_difference(part[k], -part[k - 1]);
            part[k] = sum.high, part[k - 1] = sum.low;
        }
    return part[15];
}

/// a * b - c * d, its sign without error.
FN Real signed_difference_of_products(TwoReal a, TwoReal b, TwoReal c, TwoReal d) {
    Real value = two_difference_of_products(a, b, c, d).high;
    Real doubt =
        (absR(a.high * b.high) + absR(c.high * d.high)) * R(9.094947017729282e-13); // 2^-40
    Mask open = !(absR(value) > doubt);
    if (someLane(open)) value = sel(open, exact_difference_of_products(a, b, c, d), value);
    return value;
}

/// x * over / under, off by a few 2^-47 of it.
FN TwoReal two_scaled(Real x, Real over, Real under) {
    Real inverse = R(1.) / under, product = x * over;
    Real quotient = product * inverse;
    Real remainder = fmaR(-quotient, under, product) + fmaR(x, over, -product);
    return two_real(quotient, remainder * inverse);
}

FN TwoReal3 two_difference3(vec3 a, vec3 b) {
    TwoReal3 r;
    r.x = two_difference(a.x, b.x);
    r.y = two_difference(a.y, b.y);
    r.z = two_difference(a.z, b.z);
    return r;
}

FN TwoReal3 two_scale3(TwoReal3 a, Real power_of_two) {
    TwoReal3 r;
    r.x = two_scale(a.x, power_of_two);
    r.y = two_scale(a.y, power_of_two);
    r.z = two_scale(a.z, power_of_two);
    return r;
}

FN TwoReal3 two_cross3(TwoReal3 a, TwoReal3 b) {
    TwoReal3 r;
    r.x = two_difference_of_products(a.y, b.z, a.z, b.y);
    r.y = two_difference_of_products(a.z, b.x, a.x, b.z);
    r.z = two_difference_of_products(a.x, b.y, a.y, b.x);
    return r;
}

FN TwoReal two_dot3(TwoReal3 a, TwoReal3 b) {
    return two_add(two_add(two_multiply(a.x, b.x), two_multiply(a.y, b.y)), two_multiply(a.z, b.z));
}

/// The high parts.
FN vec3 high3(TwoReal3 a) { return v3(a.x.high, a.y.high, a.z.high); }
