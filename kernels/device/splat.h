// Splatting: a sample counts for every pixel within the reach of the reconstruction filter, with
// the filter's value there.
//
// A block's samples go to a tile of the film of its own, so that work-items never write to the same
// place; where tiles overlap, the host adds them up. SPLAT_SAMPLES samples are added up for each
// cell, in an order that is the same for any number of lanes, before the film gets their sum.

#define REACH_PIXELS (2 * FILTER_REACH_LIMIT + 1)

/// The weights of a packet's samples along both axes for the pixels from -reach to reach; those
/// along y hold the sample's own weight too.
typedef struct {
    Real x[REACH_PIXELS], y[REACH_PIXELS];
} SplatWeights;

/// Value of the filter so many pixels from its centre.
FN Real filter_value(global const float* values, Real distance) {
    Real scaled = distance * (float)FILTER_INTERVALS;
    Int interval = toInt(scaled);
    Real begin = gather(values, interval), end = gather(values, interval + 1);
    return begin + (end - begin) * (scaled - toReal(interval));
}

FN void splat_weights(SplatWeights* w, global const float* values, int reach, Real offset_x,
                      Real offset_y, Real weight) {
    for (int k = -reach; k <= reach; k++) {
        w->x[k + reach] = filter_value(values, absR((float)k - offset_x));
        w->y[k + reach] = weight * filter_value(values, absR((float)k - offset_y));
    }
}

#if LANES > 1
typedef float4 Float4Anywhere __attribute__((aligned(4)));
typedef union {
    Real lanes;
    float4 rows[LANES / 4];
} PixelRows;
#endif

/// Adds a part of a block's pixels to the tile, the block's corner at (x, y).
FN void tile_add(Scalar* tile, int side, int x, int y, int part, Real v) {
#if LANES == 1
    tile[(y + part / 4) * side + x + part % 4] += v;
#else
    PixelRows pixels;
    pixels.lanes = v;
    Scalar* corner = tile + (y + part * (LANES / 4)) * side + x;
    for (int row = 0; row < LANES / 4; row++) {
    private
        Float4Anywhere* cells = (private Float4Anywhere*)(corner + row * side);
        *cells += pixels.rows[row];
    }
#endif
}

/// Adds `count` samples of a part's pixels, one value each, to the tile. For each cell pixels come
/// in the order of their numbers, and of each pixel the sum of its samples.
FN void tile_splat(Scalar* tile, int reach, int part, const Real* values,
                   const SplatWeights* weights, int count) {
    int side = TILE_SIDE(reach);
    for (int y = 2 * reach; y >= 0; y--) {
        Real row[SPLAT_SAMPLES];
        for (int n = 0; n < count; n++)
            row[n] = values[n] * weights[n].y[y];
        for (int x = 2 * reach; x >= 0; x--) {
            Real sum = R(0.);
            for (int n = 0; n < count; n++)
                sum = fmaR(row[n], weights[n].x[x], sum);
            tile_add(tile, side, x, y, part, sum);
        }
    }
}

/// Splats the samples [first, first + count) of a block to its tile, count <= SPLAT_SAMPLES.
/// Returns how many samples were not finite and are left out.
FN uint splat_block(BlockResults block, WaveParams wave, int first, int count,
                    global const float* filter, const RenderParams* params, int film_channels,
                    global Scalar* sums, global Scalar* errors) {
    SplatWeights weights[BLOCK_PARTS][SPLAT_SAMPLES];
    uint good[BLOCK_PARTS][SPLAT_SAMPLES];
    int reach = params->filter_reach;
    uint dropped = 0;
    for (int part = 0; part < BLOCK_PARTS; part++)
        for (int n = 0; n < count; n++) {
            Int slot = part_slots(wave, part, first + n);
            Mask finite = finite_samples(block, slot);
            good[part][n] = maskBits(finite);
            dropped += LANES - popcount(good[part][n]);
            Real weight = sel(finite, block_result(block, result_weight, slot), R(0.));
            splat_weights(&weights[part][n], filter, reach,
                          block_result(block, block.squares, slot),
                          block_result(block, block.squares + 1, slot), weight);
        }
    for (int channel = 0; channel < film_channels; channel++) {
        Real tile[TILE_CELLS(FILTER_REACH_LIMIT) / LANES];
        for (int k = 0; k < TILE_CELLS(reach) / LANES; k++)
            tile[k] = R(0.);
        for (int part = 0; part < BLOCK_PARTS; part++) {
            Real values[SPLAT_SAMPLES];
            for (int n = 0; n < count; n++)
                values[n] =
                    sel(lanesOf(good[part][n]),
                        sample_value(block, channel, part_slots(wave, part, first + n)), R(0.));
            tile_splat((Scalar*)tile, reach, part, values, weights[part], count);
        }
        for (int k = 0; k < TILE_CELLS(reach) / LANES; k++) {
            long cell = (long)channel * params->film_stride + k * LANES;
            film_add(sums + cell, errors + cell, tile[k]);
        }
    }
    return dropped;
}
