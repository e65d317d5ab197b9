// Sums of singles without any error, whatever their order: a long accumulator (Kulisch and Miranker
// 1981), EXACT_WORDS digits to base 2^32 in two's complement, the lowest bit of which is worth
// 2^-149.
//
// Every single is a whole number of those, and 2^42 of the largest fit. An infinite one counts for
// 2^140, which no sum of finite ones of a render reaches.

#define EXACT_INFINITE_PLACE 266 // 2^23 from there on is 2^140

/// What a single adds: its 24 bits in two digits, `word` and the one above, and their sign as a
/// digit, 0 or all ones.
typedef struct {
    Int word;
    Uint low, high, sign;
} ExactPart;

FN ExactPart exact_part(Real x) {
    Int place = sel(finiteR(x), lowestPlace(x), (Int)EXACT_INFINITE_PLACE);
    Uint bits = significand(x), by = asUint(place & 31);
    ExactPart p;
    p.word = place >> 5;
    p.low = bits << by;
    p.high = (bits >> 1) >> (31u - by);
    p.sign = asUint(sel(x < R(0.), (Int)(-1), (Int)0));
    return p;
}

/// A digit of a sum, and what the next one gets.
typedef struct {
    Uint digit, carry;
} ExactDigit;

/// Digit k of a sum with a part's added: its bits are turned where it is negative, and 1 is added
/// at the lowest of them.
FN ExactDigit exact_digit(ExactPart p, int k, Uint before, Uint carry) {
    Uint magnitude = sel(p.word == k, p.low, sel(p.word == k - 1, p.high, (Uint)0u));
    Uint added = sel(p.word > k, (Uint)0u, magnitude ^ p.sign);
    Uint more = sel(p.word == k, p.sign & 1u, carry);
    Uint sum = before + added;
    Uint digit = sum + more;
    ExactDigit r;
    r.digit = digit;
    r.carry = sel(sum < added, (Uint)1u, (Uint)0u) | sel(digit < sum, (Uint)1u, (Uint)0u);
    return r;
}

/// Whether digits above k change, once k has.
FN Mask exact_goes_on(ExactPart p, int k, Uint carry) {
    return (p.word > k) | ((p.word == k) & (p.high != 0u)) | ((p.sign + carry) != 0u);
}
