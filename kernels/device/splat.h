// Splatting: a sample counts for every pixel within the reach of the reconstruction filter, with
// the filter's value there.
//
// A block's samples go to a tile of the film of its own, so that work-items never write to the same
// place; where tiles overlap, the host adds them up. FILM_SAMPLES samples are added up for each
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
// A row of a block.
typedef float4 Float4Anywhere __attribute__((aligned(4)));
typedef union {
    Real lanes;
    float4 rows[LANES / BLOCK_SIDE];
} PixelRows;
#endif

/// Adds a part of a block's pixels to the tile, the block's corner at (x, y).
FN void tile_add(Scalar* tile, int side, int x, int y, int part, Real v) {
#if LANES == 1
    tile[(y + BLOCK_ROW(part)) * side + x + BLOCK_COLUMN(part)] += v;
#else
    PixelRows pixels;
    pixels.lanes = v;
    Scalar* corner = tile + (y + part * (LANES / BLOCK_SIDE)) * side + x;
    for (int row = 0; row < LANES / BLOCK_SIDE; row++) {
    private
        Float4Anywhere* cells = (private Float4Anywhere*)(corner + row * side);
        *cells += pixels.rows[row];
    }
#endif
}

/// What the tile has for a part of a block's pixels.
FN Real tile_load(const Scalar* tile, int side, int x, int y, int part) {
#if LANES == 1
    return tile[(y + BLOCK_ROW(part)) * side + x + BLOCK_COLUMN(part)];
#else
    PixelRows pixels;
    const Scalar* corner = tile + (y + part * (LANES / BLOCK_SIDE)) * side + x;
    for (int row = 0; row < LANES / BLOCK_SIDE; row++)
        pixels.rows[row] = *(private const Float4Anywhere*)(corner + row * side);
    return pixels.lanes;
#endif
}

/// Adds `count` samples of a part's pixels, one value each, to the tile. For each cell pixels come
/// in the order of their numbers, and of each pixel the sum of its samples.
FN void tile_splat(Scalar* tile, int reach, int part, const Real* values,
                   const SplatWeights* weights, int count) {
    int side = TILE_SIDE(reach);
    for (int y = 2 * reach; y >= 0; y--) {
        Real row[FILM_SAMPLES];
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

typedef struct {
    SplatWeights of[FILM_SAMPLES];
} GroupWeights;

FN void group_weights(GroupWeights* w, BlockResults block, const SampleGroup* g,
                      global const float* filter, int reach) {
    for (int n = 0; n < g->count; n++)
        splat_weights(&w->of[n], filter, reach, block_result(block, block.behind, g->slot[n]),
                      block_result(block, block.behind + 1, g->slot[n]), g->weight[n]);
}

/// Splats a group of samples of each part of a block to its tile.
FN void splat_groups(BlockResults block, const SampleGroup* groups, global const float* filter,
                     int reach, FilmTile film) {
    GroupWeights weights[BLOCK_PARTS];
    int count = groups[0].count, cells = TILE_CELLS(reach) / LANES;
    for (int part = 0; part < BLOCK_PARTS; part++)
        group_weights(&weights[part], block, &groups[part], filter, reach);
    for (int channel = 0; channel < film.channels; channel++) {
        Real tile[TILE_CELLS(FILTER_REACH_LIMIT) / LANES];
        for (int k = 0; k < cells; k++)
            tile[k] = R(0.);
        for (int part = 0; part < BLOCK_PARTS; part++) {
            Real values[FILM_SAMPLES];
            for (int n = 0; n < count; n++)
                values[n] = group_value(block, &groups[part], channel, n);
            tile_splat((Scalar*)tile, reach, part, values, weights[part].of, count);
        }
        for (int k = 0; k < cells; k++)
            film_add(film, channel, k * LANES, tile[k]);
    }
}
