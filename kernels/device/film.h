// The film: what a group of finished samples adds to it, and which samples are left out.

/// The film of one block: a tile of every digit of every channel.
typedef struct {
    global uint* digits;
    long stride;  // words between two digits
    int channels; // of sums; those of spreads follow
} FilmTile;

/// Adds singles to the sums of a packet of cells. Digits below and above those that change are left
/// alone: pages of which none has ever changed take no memory on a CPU.
FN void film_add_single(FilmTile film, int channel, int cell, Real v) {
    ExactPart part = exact_part(v);
    int lowest = lowestLaneInt(sel(v == R(0.), (Int)EXACT_WORDS, part.word));
    Uint carry = (Uint)0u;
    for (int k = lowest; k < EXACT_WORDS; k++) {
        global uint* digits = film.digits + (channel * EXACT_WORDS + k) * film.stride + cell;
        ExactDigit sum = exact_digit(part, k, LOAD_UINT(digits), carry);
        STORE_UINT(digits, sum.digit);
        carry = sum.carry;
        if (!someLane(exact_goes_on(part, k, carry))) return;
    }
}

/// Adds v, whatever its precision.
FN void film_add(FilmTile film, int channel, int cell, Real v) {
    for (int part = 0; part < (int)SINGLES_IN_REAL; part++) {
        Real single = singleR(v);
        film_add_single(film, channel, cell, single);
        v = sel(finiteR(single), v - single, R(0.));
    }
}

/// What the samples of a block have gathered.
typedef struct {
    global const Scalar* results; // from the block's first slot on
    long stride;                  // floats between two channels
    int behind;                   // the first channel behind AOVs: offsets; the film's squares
} BlockResults;

FN Real block_result(BlockResults b, int channel, Int slot) {
    return gather(b.results + channel * b.stride, slot);
}

/// A group of samples of a part of a block's pixels. Those that are not finite are left out: they
/// have no weight, and nothing to be weighted.
typedef struct {
    Int slot[FILM_SAMPLES];
    uint good[FILM_SAMPLES]; // which lanes' samples are finite
    Real weight[FILM_SAMPLES];
    Real radiance[3][FILM_SAMPLES];
    uint bad; // lanes with a sample that is not
    int count;
} SampleGroup;

FN SampleGroup sample_group(BlockResults block, WaveParams wave, int part, int first, int count) {
    SampleGroup g;
    Real none = R(0.);
    g.count = count;
    g.bad = 0;
    for (int n = 0; n < count; n++) {
        Int slot = part_slots(wave, part, first + n);
        vec3 radiance = v3(block_result(block, result_r, slot), block_result(block, result_g, slot),
                           block_result(block, result_b, slot));
        Real weight = block_result(block, result_weight, slot);
        Mask good = finite3(radiance) & finiteR(weight);
        g.slot[n] = slot;
        g.good[n] = maskBits(good);
        g.bad |= maskBits(!good);
        g.weight[n] = sel(good, weight, none);
        g.radiance[0][n] = sel(good, radiance.x, none);
        g.radiance[1][n] = sel(good, radiance.y, none);
        g.radiance[2][n] = sel(good, radiance.z, none);
    }
    return g;
}

/// What a sample of a group has for a channel of the film, to be weighted.
FN Real group_value(BlockResults block, const SampleGroup* g, int channel, int n) {
    if (channel <= result_b) return g->radiance[channel][n];
    if (channel == result_weight) return R(1.);
    if (channel >= block.behind) return square(g->radiance[channel - block.behind][n]);
    return sel(lanesOf(g->good[n]), block_result(block, channel, g->slot[n]), R(0.));
}

/// Adds samples of a group one by one in the lanes where their sum is more than a Real holds.
FN_APART void add_huge(BlockResults block, const SampleGroup* g, int channel, FilmTile film,
                       int cell, Mask huge) {
    for (int n = 0; n < g->count; n++)
        film_add(film, channel, cell,
                 sel(huge, group_value(block, g, channel, n) * g->weight[n], R(0.)));
}

/// Adds a group to the pixels its samples lie in.
FN void add_group(BlockResults block, const SampleGroup* g, FilmTile film, int part) {
    for (int channel = 0; channel < film.channels; channel++) {
        TwoReal sum = two_real(R(0.), R(0.));
        for (int n = 0; n < g->count; n++)
            sum = group_add(sum, group_value(block, g, channel, n) * g->weight[n]);
        Mask fits = finiteR(sum.high);
        if (RARELY(someLane(!fits))) add_huge(block, g, channel, film, part * LANES, !fits);
        film_add(film, channel, part * LANES, sel(fits, sum.high, R(0.)));
        film_add(film, channel, part * LANES, sel(fits, sum.low, R(0.)));
    }
}
