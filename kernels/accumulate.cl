// Accumulate: the finished samples of a wave go to the film, in groups, in any order.
#include "device/device.h"

#include "device/lanes_memory.h"
#include "device/wave.h"

#include "device/film.h"
#include "device/splat.h"

#include "device/film_spread.h"

#if LANES > BLOCK_PIXELS
#error "a packet must not be wider than a block of pixels"
#endif

/// What is known of the bad samples of a block.
typedef struct {
    global ulong* counts; // for each fault
    global int* first;    // BAD_SAMPLE_FIELDS
    int x, y;             // pixel in the block's corner
    int sample;           // number of the group's first
} BadSamples;

/// A lane of a part of a block's pixels, and a sample of its group.
FN void note_bad_sample(BlockResults block, const SampleGroup* g, int part, int lane, int n,
                        BadSamples bad) {
    IntLanes slots;
    slots.lanes = g->slot[n];
    global const Scalar* of_sample = block.results + slots.at[lane];
    Scalar weight = AT(global const Scalar, of_sample + result_weight * block.stride, 0);
    int told = (int)(weight != weight); // by the stage that made it
    int code = told ? (int)AT(global const Scalar, of_sample + result_alpha * block.stride, 0)
                    : (int)fault_sum;
    AT(global ulong, bad.counts, code % fault_count)++;
    if (AT(global int, bad.first, bad_sample_known)) return;
    int pixel = part * LANES + lane;
    AT(global int, bad.first, bad_sample_known) = 1;
    AT(global int, bad.first, bad_sample_sample) = bad.sample + n;
    AT(global int, bad.first, bad_sample_x) = bad.x + BLOCK_COLUMN(pixel);
    AT(global int, bad.first, bad_sample_y) = bad.y + BLOCK_ROW(pixel);
    AT(global int, bad.first, bad_sample_fault) = code % fault_count;
    AT(global int, bad.first, bad_sample_bounce) = told ? code / fault_count : -1;
}

/// In the order of samples, then pixels.
FN void note_bad_samples(BlockResults block, const SampleGroup* groups, BadSamples bad) {
    for (int n = 0; n < groups[0].count; n++)
        for (int part = 0; part < BLOCK_PARTS; part++) {
            uint bits = maskBits(!lanesOf(groups[part].good[n]));
            for (; bits; bits &= bits - 1)
                note_bad_sample(block, &groups[part], part, lowest_bit(bits), n, bad);
        }
}

/// Adds a group of `count` samples of a block, from `first` of the wave on, to the film.
FN void add_samples(BlockResults block, WaveParams wave, int first, int count,
                    global const float* filter, int reach, FilmTile film, BadSamples bad) {
    SampleGroup groups[BLOCK_PARTS];
    uint any_bad = 0;
    for (int part = 0; part < BLOCK_PARTS; part++) {
        groups[part] = sample_group(block, wave, part, first, count);
        any_bad |= groups[part].bad;
    }
    if (RARELY(any_bad)) note_bad_samples(block, groups, bad);
    if (HAS(filter_splatting)) {
        splat_groups(block, groups, filter, reach, film);
        if (HAS(variance)) splat_spreads(block, groups, filter, reach, film);
    } else {
        for (int part = 0; part < BLOCK_PARTS; part++) {
            add_group(block, &groups[part], film, part);
            if (HAS(variance)) join_group(&groups[part], film, part);
        }
    }
}

/// Reads: the wave's blocks, results, filter values. Writes: film (one work-item owns a tile); of
/// samples that are not finite, which are left out, statistics (how many) and where the first was.
/// What is added is told by the group alone, and added without error: sums do not depend on the
/// waves.
kernel void accumulate(KERNEL_PARAMETERS) {
    CHECK_BOUNDS();
    int block = get_global_id(0);
    if (block >= wave.block_count) return;
    WaveBlock at = wave_block(wave_blocks, block);
    int tile = at.block;
    BlockResults gathered;
    gathered.results = results + (long)block * wave.sample_count * BLOCK_PIXELS;
    gathered.stride = params.result_stride;
    gathered.behind = AOV_CHANNEL(params.aov_channels);
    FilmTile of_film;
    of_film.stride = params.film_stride;
    of_film.channels = SPREAD_CHANNEL(params.aov_channels, HAS(moments));
    of_film.digits = film + (long)(tile - wave.film_first) * TILE_CELLS(params.filter_reach);
    BadSamples bad;
    bad.counts = statistics + statistic_count * block + statistic_first_fault;
    bad.first = bad_samples + bad_sample_field_count * (long)tile;
    bad.x = params.block_x + tile % params.blocks_x * BLOCK_SIDE;
    bad.y = params.block_y + tile / params.blocks_x * BLOCK_SIDE;
    for (int first = 0; first < wave.sample_count; first += FILM_SAMPLES) {
        bad.sample = at.first_sample + first;
        add_samples(gathered, wave, first, min(FILM_SAMPLES, wave.sample_count - first),
                    filter_values, params.filter_reach, of_film, bad);
    }
}
