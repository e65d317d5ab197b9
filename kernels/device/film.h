// The film: sums that do not drift, and what a finished sample adds to them.

/// Adds v to a sum kept as two floats (TwoSum, Knuth): the error of each addition is carried, so
/// 1e9 samples do not drift.
FN void film_add(global float* sum, global float* error, Real v) {
    Real a = LOAD_REAL(sum);
    Real s = a + v;
    Real b = s - a;
    Real e = (a - (s - b)) + (v - b);
    STORE_REAL(sum, s);
    STORE_REAL(error, LOAD_REAL(error) + e);
}

/// The samples of a packet's slots whose radiance is finite; the others are left out.
FN Mask finite_samples(global const float* results, long stride, long slot) {
    return finite3(v3(LOAD_REAL(results + result_r * stride + slot),
                      LOAD_REAL(results + result_g * stride + slot),
                      LOAD_REAL(results + result_b * stride + slot)));
}

/// What a sample has for a channel of the film, to be weighted; `squares` is the first channel of
/// second moments.
FN Real sample_value(global const float* results, long stride, long slot, int channel,
                     int squares) {
    if (channel == result_weight) return R(1.);
    if (channel < squares) return LOAD_REAL(results + channel * stride + slot);
    return square(LOAD_REAL(results + (channel - squares) * stride + slot));
}
