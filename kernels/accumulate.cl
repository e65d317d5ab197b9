// Accumulate: the finished samples of a wave go to the film, in the order of their numbers.
#include "device/device.h"
#include "device/lanes_memory.h"
#include "device/path_state.h"

#if LANES > BLOCK_PIXELS
#error "a packet must not be wider than a block of pixels"
#endif

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

/// Reads: results. Writes: film (one work-item owns a block of pixels), statistics (non-finite
/// samples, dropped and counted). The samples of a pixel are added one by one in the order of their
/// numbers, so the sum does not depend on the waves.
kernel void accumulate(KERNEL_PARAMETERS) {
    int block = get_global_id(0);
    if (block >= wave.block_count) return;
    int channels = result_field_count + params.aov_channels;
    int film_channels = channels + (HAS(moments) ? 3 : 0);
    uint dropped = 0;
    for (int part = 0; part < BLOCK_PIXELS; part += LANES) {
        long pixel = (long)(wave.first_block + block) * BLOCK_PIXELS + part;
        global float* sums = film + pixel;
        global float* errors = film + (long)film_channels * params.film_stride + pixel;
        for (int sample = 0; sample < wave.sample_count; sample++) {
            long slot = ((long)block * wave.sample_count + sample) * BLOCK_PIXELS + part;
            Real weight = LOAD_REAL(RESULT(result_weight) + slot);
            vec3 radiance =
                v3(LOAD_REAL(RESULT(result_r) + slot), LOAD_REAL(RESULT(result_g) + slot),
                   LOAD_REAL(RESULT(result_b) + slot));
            Mask good = finite3(radiance);
            dropped += (uint)popcount(maskBits(!good));
            for (int c = 0; c < channels; c++) {
                Real v = c == result_weight ? weight : LOAD_REAL(RESULT(c) + slot) * weight;
                film_add(sums + (long)c * params.film_stride, errors + (long)c * params.film_stride,
                         sel(good, v, R(0.)));
            }
            if (HAS(moments)) {
                for (int c = 0; c < 3; c++) {
                    Real v = square(LOAD_REAL(RESULT(c) + slot)) * weight;
                    film_add(sums + (long)(channels + c) * params.film_stride,
                             errors + (long)(channels + c) * params.film_stride,
                             sel(good, v, R(0.)));
                }
            }
        }
    }
    if (dropped)
        statistics[statistic_count * block + statistic_non_finite_samples] += (ulong)dropped;
}
