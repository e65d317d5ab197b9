// Accumulate: the finished samples of a wave go to the film, in the order of their numbers.
#include "device/device.h"
#include "device/lanes_memory.h"
#include "device/path_state.h"
#include "device/wave.h"

#include "device/film.h"
#include "device/splat.h"

#include "device/film_spread.h"

#if LANES > BLOCK_PIXELS
#error "a packet must not be wider than a block of pixels"
#endif

/// Adds a group of `count` samples of a block, from `first` of the wave on, to the film. Returns
/// how many samples were not finite and are left out.
FN uint add_samples(BlockResults block, WaveParams wave, int first, int count,
                    global const float* filter, int reach, FilmTile film) {
    SampleGroup groups[BLOCK_PARTS];
    uint dropped = 0;
    for (int part = 0; part < BLOCK_PARTS; part++) {
        groups[part] = sample_group(block, wave, part, first, count);
        dropped += dropped_samples(&groups[part]);
    }
    if (HAS(filter_splatting)) {
        splat_groups(block, groups, filter, reach, film);
        if (HAS(variance)) splat_spreads(block, groups, filter, reach, film);
    } else {
        for (int part = 0; part < BLOCK_PARTS; part++) {
            add_group(block, &groups[part], film, part);
            if (HAS(variance)) join_group(&groups[part], film, part);
        }
    }
    return dropped;
}

/// Reads: results, filter values. Writes: film (one work-item owns a tile), statistics (non-finite
/// samples, dropped and counted). Samples are added in groups in the order of their numbers, so the
/// sums do not depend on the waves.
kernel void accumulate(KERNEL_PARAMETERS) {
    int block = get_global_id(0);
    if (block >= wave.block_count) return;
    BlockResults gathered;
    gathered.results = results + (long)block * wave.sample_count * BLOCK_PIXELS;
    gathered.stride = params.result_stride;
    gathered.squares = result_field_count + params.aov_channels;
    FilmTile tile;
    tile.stride = params.film_stride;
    tile.channels = gathered.squares + (HAS(moments) ? 3 : 0);
    tile.high = film + (long)(wave.first_block + block) * TILE_CELLS(params.filter_reach);
    int channels = tile.channels + (HAS(variance) ? spread_channel_count : 0);
    tile.low = tile.high + (long)channels * tile.stride;
    uint dropped = 0;
    for (int first = 0; first < wave.sample_count; first += FILM_SAMPLES)
        dropped += add_samples(gathered, wave, first, min(FILM_SAMPLES, wave.sample_count - first),
                               filter_values, params.filter_reach, tile);
    if (dropped)
        statistics[statistic_count * block + statistic_non_finite_samples] += (ulong)dropped;
}
