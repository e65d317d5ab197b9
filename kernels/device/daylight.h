// The sun and the sky about it by their formula: what a ray sees of them, and choosing directions
// by the sun's cone and the table of an image of the sky (environment.h), which tells how likely
// the places of the sky are, never how bright. The words of the formula come first, the table
// behind.
#ifndef PARHELION_DAYLIGHT_H
#define PARHELION_DAYLIGHT_H

#include "device/environment.h"

/// One of DAYLIGHT_WORDS, in all lanes.
FN Real daylight_word(SceneTables scene, int word) {
    global const float* words = (global const float*)scene.environment;
    return (Real)AT(global const float, words, word);
}

FN global const int* daylight_table(SceneTables scene) {
    return scene.environment + DAYLIGHT_WORDS;
}

FN vec3 daylight_vector(SceneTables scene, int word) {
    return v3(daylight_word(scene, word), daylight_word(scene, word + 1),
              daylight_word(scene, word + 2));
}

/// Radiance of the sky, of one of three colours.
FN Real daylight_sky_color(SceneTables scene, int color, DaylightPlace place) {
    int word = DAYLIGHT_SKY + color * DAYLIGHT_SKY_WORDS;
    SkyFormula k;
#define DAYLIGHT_LOAD(field) k.field = daylight_word(scene, word++);
    DAYLIGHT_SKY_FIELDS(DAYLIGHT_LOAD)
    return sky_formula(k, place);
}

/// Towards w (in the sky's frame); `in_sun`: lanes that are within the sun's cone, however they
/// are rounded.
FN SkySeen daylight_towards(SceneTables scene, Light l, int texture, vec3 w, Mask in_sun,
                            Mask wanted) {
    vec3 sun = daylight_vector(scene, DAYLIGHT_SUN_DIRECTION);
    DaylightPlace place = daylight_place(w, sun);
    Mask above = wanted & (place.up >= R(0.));
    SkySeen seen;
    seen.radiance = splat3(R(0.));
    seen.pdf = R(0.);
    if (HAS(daylight_sky)) {
        seen.radiance = v3(daylight_sky_color(scene, 0, place), daylight_sky_color(scene, 1, place),
                           daylight_sky_color(scene, 2, place));
        if (HAS(next_event)) {
            Sky sky = load_sky(scene, texture);
            SkyPlace at = sky_place(w, sky.image.width, sky.rows);
            SkyCell cell = sky_cell(scene, sky, at.column, at.row, wanted);
            cell.probability = sky_probability(daylight_table(scene), sky, at.column, at.row);
            seen.pdf = sky_density(cell, at, sky.image.width, sky.rows);
        }
    }
    if (HAS(daylight_sun)) {
        Real edge = daylight_word(scene, DAYLIGHT_SUN_EDGE);
        Mask on_disk = in_sun | (place.chord_squared <= edge);
        vec3 radiance = add3(seen.radiance, daylight_vector(scene, DAYLIGHT_SUN_RADIANCE));
        seen.radiance = sel3(on_disk, radiance, seen.radiance);
        Real sky_share = daylight_word(scene, DAYLIGHT_SKY_SHARE) * R(.00390625); // of 256
        Real density = (R(1.) - sky_share) / (edge * R(PI));
        seen.pdf = sky_share * seen.pdf + sel(on_disk, density, R(0.));
    }
    seen.radiance = sel3(above, mul3(light_radiance(l), seen.radiance), splat3(R(0.)));
    seen.pdf = seen.pdf * l.pmf;
    return seen;
}

/// Towards w (world space).
FN SkySeen daylight_seen(SceneTables scene, Light l, int texture, vec3 w, Mask wanted) {
    vec3 turned = sel3(wanted, sky_from_world(l, w), v3(R(0.), R(1.), R(0.)));
    return daylight_towards(scene, l, texture, turned, wanted & !wanted, wanted);
}

/// A direction by the last two random numbers of a light's draw.
FN EmitterSample daylight_chosen(SceneTables scene, Light l, int texture, Random4 r, Mask wanted) {
    Mask by_sun = wanted & !wanted;
    vec3 w = v3(R(0.), R(1.), R(0.));
    Uint from_sky = r.z;
    if (HAS(daylight_sun)) {
        Int of_sky = toInt(daylight_word(scene, DAYLIGHT_SKY_SHARE)), of_sun = (Int)256 - of_sky;
        by_sun = wanted & (asInt(r.z >> 24) < of_sun);
        // Each part of r.z is all of a number again.
        vec2 u = v2(uniform01(r.z) * (R(256.) / toReal(of_sun)), uniform01(r.w));
        w = sun_direction(daylight_vector(scene, DAYLIGHT_SUN_DIRECTION),
                          daylight_word(scene, DAYLIGHT_SUN_EDGE), u);
        if (HAS(daylight_sky)) from_sky = (r.z - (asUint(of_sun) << 24)) / asUint(of_sky) << 8;
    }
    if (HAS(daylight_sky)) {
        Random4 rest = r;
        rest.z = sel(by_sun, (Uint)0u, from_sky);
        Sky sky = load_sky(scene, texture);
        SkyChoice chosen = sky_choice(scene, daylight_table(scene), sky, rest, wanted & !by_sun);
        w = sel3(by_sun, w, chosen.sample.w);
    }
    SkySeen seen = daylight_towards(scene, l, texture, w, by_sun, wanted);
    Mask lit = wanted & (seen.pdf > R(0.));
    EmitterSample s = emitter_sample_none();
    s.wi = sel3(lit, sky_to_world(l, w), s.wi);
    s.inverse_pdf = sel(lit, R(1.) / sel(lit, seen.pdf, R(1.)), R(0.));
    s.weight = scale3(seen.radiance, s.inverse_pdf);
    s.distant = seen.pdf == seen.pdf;
    return s;
}

#endif
