// The film: sums that do not drift, and what a finished sample adds to them.

/// Adds v to a sum kept as two floats (TwoSum, Knuth): the error of each addition is carried, so
/// 1e9 samples do not drift.
FN void film_add(global Scalar* sum, global Scalar* error, Real v) {
    Real a = LOAD_REAL(sum);
    Real s = a + v;
    Real b = s - a;
    Real e = (a - (s - b)) + (v - b);
    STORE_REAL(sum, s);
    STORE_REAL(error, LOAD_REAL(error) + e);
}

/// What the samples of a block have gathered.
typedef struct {
    global const Scalar* results; // from the block's first slot on
    long stride;                  // floats between two channels
    int squares;                  // the first channel of second moments, behind all results
} BlockResults;

FN Real block_result(BlockResults b, int channel, Int slot) {
    return gather(b.results + channel * b.stride, slot);
}

/// The samples whose radiance is finite; the others are left out.
FN Mask finite_samples(BlockResults b, Int slot) {
    return finite3(v3(block_result(b, result_r, slot), block_result(b, result_g, slot),
                      block_result(b, result_b, slot)));
}

/// What a sample has for a channel of the film, to be weighted.
FN Real sample_value(BlockResults b, int channel, Int slot) {
    if (channel == result_weight) return R(1.);
    if (channel < b.squares) return block_result(b, channel, slot);
    return square(block_result(b, channel - b.squares, slot));
}
