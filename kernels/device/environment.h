// The sky's image and its table of probabilities: looking up what a ray sees of it, and choosing
// directions by it.
//
// The table holds shares of 2^30: of each row of cells those before it, and all; behind that, of
// each cell of a row, the same within its row.
#ifndef PARHELION_ENVIRONMENT_H
#define PARHELION_ENVIRONMENT_H

#include "device/texture.h"

typedef struct {
    Texture image;
    Int rows; // of cells
} Sky;

FN Sky load_sky(SceneTables scene, int texture) {
    Sky sky;
    sky.image = load_Texture(scene.textures, (Int)texture);
    sky.rows = sky.image.height - 1;
    return sky;
}

/// The word where the shares of a row's cells begin.
FN Int sky_row_shares(Sky sky, Int row) { return sky.rows + 1 + row * (sky.image.width + 1); }

FN Real sky_share(global const int* table, Int at) {
    return toReal(gather_int(table, at + 1) - gather_int(table, at)) *
           R(9.31322574615478515625e-10); // 2^-30
}

FN SkyCell sky_cell(SceneTables scene, Sky sky, Int column, Int row, Mask wanted) {
    Int next = sel(column + 1 < sky.image.width, column + 1, (Int)0);
    Mask south = sky_south(row, sky.rows);
    Int near = sel(south, row + 1, row), far = sel(south, row, row + 1);
    Image i = image_of(sky.image, wanted);
    SkyCell c;
    c.near_first = texel_at(scene, i, column, near);
    c.near_next = texel_at(scene, i, next, near);
    c.far_first = texel_at(scene, i, column, far);
    c.far_next = texel_at(scene, i, next, far);
    c.probability = R(0.);
    return c;
}

/// With which the cell is chosen.
FN Real sky_probability(global const int* table, Sky sky, Int column, Int row) {
    return sky_share(table, row) * sky_share(table, sky_row_shares(sky, row) + column);
}

/// The last of `count` entries from `first` on whose share begins at x or before.
FN Int sky_entry(global const int* table, Int first, Int count, Int x) {
    Int entry = (Int)0;
    for (int step = 1 << 15; step > 0; step >>= 1) {
        Int further = entry + step;
        Mask there = further < count;
        if (!someLane(there)) continue;
        Int begins = gather_int(table, first + sel(there, further, (Int)0));
        entry = sel(there & (begins <= x), further, entry);
    }
    return entry;
}

/// Where x lies in that entry's share, 0 to 1.
FN Real sky_within(global const int* table, Int entry, Int x) {
    Int begin = gather_int(table, entry), end = gather_int(table, entry + 1);
    return (toReal(x - begin) + R(.5)) / toReal(end - begin);
}

typedef struct {
    vec3 radiance;
    Real pdf; // of choosing the direction
} SkySeen;

/// Towards w (world space).
FN SkySeen sky_seen(SceneTables scene, Light l, int texture, vec3 w, Mask wanted) {
    Sky sky = load_sky(scene, texture);
    vec3 turned = sel3(wanted, sky_from_world(l, w), v3(R(0.), R(1.), R(0.)));
    SkyPlace place = sky_place(turned, sky.image.width, sky.rows);
    SkyCell cell = sky_cell(scene, sky, place.column, place.row, wanted);
    SkySeen seen;
    seen.radiance = mul3(light_radiance(l), sky_bilinear(cell, place.along, place.down));
    seen.pdf = R(0.);
    if (HAS(next_event)) {
        cell.probability = sky_probability(scene.environment, sky, place.column, place.row);
        seen.pdf = l.pmf * sky_density(cell, place, sky.image.width, sky.rows);
    }
    return seen;
}

typedef struct {
    SkyCell cell;
    SkySample sample;
} SkyChoice;

/// A place of the image by the last two of these random numbers.
FN SkyChoice sky_choice(SceneTables scene, global const int* table, Sky sky, Random4 r,
                        Mask wanted) {
    Int down = asInt(r.z >> 2), along = asInt(r.w >> 2);
    Int row = sky_entry(table, (Int)0, sky.rows, down), cells = sky_row_shares(sky, row);
    Int column = sky_entry(table, cells, sky.image.width, along);
    SkyChoice c;
    c.cell = sky_cell(scene, sky, column, row, wanted);
    c.cell.probability = sky_probability(table, sky, column, row);
    vec2 u = v2(sky_within(table, cells + column, along), sky_within(table, row, down));
    c.sample = sky_sample(c.cell, column, row, sky.image.width, sky.rows, u);
    return c;
}

/// A direction by the last two random numbers of a light's draw.
FN EmitterSample sky_chosen(SceneTables scene, Light l, int texture, Random4 r, Mask wanted) {
    Sky sky = load_sky(scene, texture);
    SkyChoice choice = sky_choice(scene, scene.environment, sky, r, wanted);
    SkyCell cell = choice.cell;
    SkySample chosen = choice.sample;
    Real density = sky_density(cell, chosen.place, sky.image.width, sky.rows);
    Mask lit = wanted & (density > R(0.));
    EmitterSample s = emitter_sample_none();
    s.wi = sel3(lit, sky_to_world(l, chosen.w), s.wi);
    s.inverse_pdf = sel(lit, light_inverse_pmf(l) / sel(lit, density, R(1.)), R(0.));
    vec3 image = sky_bilinear(cell, chosen.place.along, chosen.place.down);
    s.weight = scale3(mul3(light_radiance(l), image), s.inverse_pdf);
    s.distant = density == density;
    return s;
}

#endif
