// Variance: how the samples of a pixel spread (film_sum.h), beside what they add up to.
//
// A sample counts by the square of its weight, as it does in the variance of a weighted mean. Each
// group is measured about a centre near its own mean, in a second pass over its samples.

/// A group's share of the sums for one colour of a packet of pixels.
FN void film_join(FilmTile film, int color, int cell, GroupSpread g) {
    SpreadTerms terms = spread_terms(g);
    for (int k = 0; k < SPREAD_TERMS_FIRST; k++)
        film_add(film, film.channels + spread_first_r + color, cell, terms.first[k]);
    for (int k = 0; k < SPREAD_TERMS_SECOND; k++)
        film_add(film, film.channels + spread_second_r + color, cell, terms.second[k]);
}

/// A mean to measure about; any number where there is no weight.
FN Real group_centre(Real sum, Real weight) {
    Mask some = weight > R(0.);
    return sel(some, sum / sel(some, weight, R(1.)), R(0.));
}

/// The spread of a group joins that of the pixels its samples lie in.
FN void join_group(const SampleGroup* g, FilmTile film, int part) {
    Real squares[FILM_SAMPLES];
    GroupSpread spread;
    int cell = part * LANES;
    spread.weight = R(0.);
    for (int n = 0; n < g->count; n++) {
        squares[n] = square(g->weight[n]);
        spread.weight = spread.weight + squares[n];
    }
    for (int color = 0; color < 3; color++) {
        Real sum = R(0.);
        for (int n = 0; n < g->count; n++)
            sum = fmaR(squares[n], g->radiance[color][n], sum);
        spread.centre = group_centre(sum, spread.weight);
        spread.first = spread.second = R(0.);
        for (int n = 0; n < g->count; n++) {
            Real d = g->radiance[color][n] - spread.centre;
            Real weighted = squares[n] * d;
            spread.first = spread.first + weighted;
            spread.second = fmaR(weighted, d, spread.second);
        }
        film_join(film, color, cell, spread);
    }
    film_add(film, film.channels + spread_weight, cell, spread.weight);
}

#define TILE_PACKETS (TILE_CELLS(FILTER_REACH_LIMIT) / LANES)

/// Sums of a group for the cells of a tile.
typedef struct {
    Real weight[TILE_PACKETS], centre[TILE_PACKETS], first[TILE_PACKETS], second[TILE_PACKETS];
} TileSpread;

FN void square_weights(GroupWeights* w, int count, int reach) {
    for (int n = 0; n < count; n++)
        for (int k = 0; k <= 2 * reach; k++) {
            w->of[n].x[k] = square(w->of[n].x[k]);
            w->of[n].y[k] = square(w->of[n].y[k]);
        }
}

/// As tile_splat: the distances of a part's samples from the cells' centres, and their squares.
FN void tile_splat_distances(TileSpread* tile, int reach, int part, const Real* values,
                             const SplatWeights* weights, int count) {
    int side = TILE_SIDE(reach);
    for (int y = 2 * reach; y >= 0; y--)
        for (int x = 2 * reach; x >= 0; x--) {
            Real centre = tile_load((const Scalar*)tile->centre, side, x, y, part);
            Real first = R(0.), second = R(0.);
            for (int n = 0; n < count; n++) {
                Real d = values[n] - centre;
                Real weighted = weights[n].y[y] * weights[n].x[x] * d;
                first = first + weighted;
                second = fmaR(weighted, d, second);
            }
            tile_add((Scalar*)tile->first, side, x, y, part, first);
            tile_add((Scalar*)tile->second, side, x, y, part, second);
        }
}

/// The spread of a group of samples of each part of a block joins that of all pixels that the
/// filter reaches.
FN void splat_spreads(BlockResults block, const SampleGroup* groups, global const float* filter,
                      int reach, FilmTile film) {
    GroupWeights squares[BLOCK_PARTS];
    TileSpread tile;
    Real values[FILM_SAMPLES];
    int count = groups[0].count, cells = TILE_CELLS(reach) / LANES;
    for (int k = 0; k < cells; k++)
        tile.weight[k] = R(0.);
    for (int n = 0; n < count; n++)
        values[n] = R(1.);
    for (int part = 0; part < BLOCK_PARTS; part++) {
        group_weights(&squares[part], block, &groups[part], filter, reach);
        square_weights(&squares[part], count, reach);
        tile_splat((Scalar*)tile.weight, reach, part, values, squares[part].of, count);
    }
    for (int color = 0; color < 3; color++) {
        for (int k = 0; k < cells; k++)
            tile.centre[k] = tile.first[k] = tile.second[k] = R(0.);
        for (int part = 0; part < BLOCK_PARTS; part++)
            tile_splat((Scalar*)tile.centre, reach, part, groups[part].radiance[color],
                       squares[part].of, count);
        for (int k = 0; k < cells; k++)
            tile.centre[k] = group_centre(tile.centre[k], tile.weight[k]);
        for (int part = 0; part < BLOCK_PARTS; part++)
            tile_splat_distances(&tile, reach, part, groups[part].radiance[color], squares[part].of,
                                 count);
        for (int k = 0; k < cells; k++) {
            GroupSpread g;
            g.weight = tile.weight[k];
            g.centre = tile.centre[k];
            g.first = tile.first[k];
            g.second = tile.second[k];
            film_join(film, color, k * LANES, g);
        }
    }
    for (int k = 0; k < cells; k++)
        film_add(film, film.channels + spread_weight, k * LANES, tile.weight[k]);
}
