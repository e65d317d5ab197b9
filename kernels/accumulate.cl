// Accumulate: the finished samples of a wave go to the film, in the order of their numbers.
#include "device/device.h"
#include "device/lanes_memory.h"
#include "device/path_state.h"
#include "device/wave.h"

#include "device/film.h"
#include "device/splat.h"

#if LANES > BLOCK_PIXELS
#error "a packet must not be wider than a block of pixels"
#endif

/// Adds the samples of a block one by one to its own pixels; as splat_block.
FN uint add_block(BlockResults block, WaveParams wave, const RenderParams* params,
                  int film_channels, global Scalar* sums, global Scalar* errors) {
    uint dropped = 0;
    for (int part = 0; part < BLOCK_PARTS; part++) {
        for (int sample = 0; sample < wave.sample_count; sample++) {
            Int slot = part_slots(wave, part, sample);
            Mask good = finite_samples(block, slot);
            dropped += (uint)popcount(maskBits(!good));
            Real weight = block_result(block, result_weight, slot);
            for (int channel = 0; channel < film_channels; channel++) {
                Real v = sample_value(block, channel, slot) * weight;
                long cell = (long)channel * params->film_stride + part * LANES;
                film_add(sums + cell, errors + cell, sel(good, v, R(0.)));
            }
        }
    }
    return dropped;
}

/// Reads: results, filter values. Writes: film (one work-item owns a tile), statistics (non-finite
/// samples, dropped and counted). Samples are added in the order of their numbers, so the sums do
/// not depend on the waves.
kernel void accumulate(KERNEL_PARAMETERS) {
    int block = get_global_id(0);
    if (block >= wave.block_count) return;
    int film_channels = result_field_count + params.aov_channels + (HAS(moments) ? 3 : 0);
    BlockResults gathered;
    gathered.results = results + (long)block * wave.sample_count * BLOCK_PIXELS;
    gathered.stride = params.result_stride;
    gathered.squares = result_field_count + params.aov_channels;
    global Scalar* sums = film + (long)(wave.first_block + block) * TILE_CELLS(params.filter_reach);
    global Scalar* errors = sums + (long)film_channels * params.film_stride;
    uint dropped = 0;
    if (HAS(filter_splatting)) {
        for (int first = 0; first < wave.sample_count; first += SPLAT_SAMPLES)
            dropped +=
                splat_block(gathered, wave, first, min(SPLAT_SAMPLES, wave.sample_count - first),
                            filter_values, &params, film_channels, sums, errors);
    } else {
        dropped = add_block(gathered, wave, &params, film_channels, sums, errors);
    }
    if (dropped)
        statistics[statistic_count * block + statistic_non_finite_samples] += (ulong)dropped;
}
