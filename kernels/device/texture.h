// Looking up textures, and what they tell of materials.
#ifndef PARHELION_TEXTURE_H
#define PARHELION_TEXTURE_H

#include "device/scene_tables.h"

/// IEEE 754 binary16, finite.
FN Real value_of_half(Uint bits) {
    Int exponent = asInt(bits >> 10 & 31u), mantissa = asInt(bits & 1023u);
    Mask small = exponent == 0;
    Real value =
        toReal(mantissa + sel(small, (Int)0, (Int)1024)) * R(5.9604644775390625e-8); // 2^-24
    Int doubled = sel(small, (Int)0, exponent - 1);
    value = value * toReal((Int)1 << (doubled & 15)) * sel(doubled > 15, R(65536.), R(1.));
    return sel((bits & 32768u) != 0u, -value, value);
}

#ifdef __OPENCL_C_VERSION__
FN Real value_of_single(Uint bits) { return asReal(bits); }
#else
FN Real value_of_single(Uint bits) { return as_float(asInt(bits)); }
#endif

/// Where an image is looked up.
typedef struct {
    Texture t;
    Mask bytes, halves, singles; // lanes whose texels have such components
    Int texel_bytes;
} Image;

FN Image image_of(Texture t, Mask wanted) {
    Image i;
    Int component = TEXTURE_COMPONENT(t.form);
    i.t = t;
    i.bytes = wanted & (component == 0);
    i.halves = wanted & (component == 1);
    i.singles = wanted & (component == 2);
    i.texel_bytes = sel((t.form & TEXTURE_GREY) != 0, (Int)1, (Int)3) << component;
    return i;
}

FN vec3 texel_of_bytes(SceneTables scene, Uint at, Int form) {
    Uint word = gather_at_byte(scene.texels, at); // the fourth is the next texel's
    Int table = sel((form & TEXTURE_LINEAR) != 0, (Int)256, (Int)0);
    return v3(gather(scene.byte_values, asInt(word & 255u) + table),
              gather(scene.byte_values, asInt(word >> 8 & 255u) + table),
              gather(scene.byte_values, asInt(word >> 16 & 255u) + table));
}

FN vec3 texel_of_halves(SceneTables scene, Uint at) {
    Uint first = gather_at_byte(scene.texels, at), second = gather_at_byte(scene.texels, at + 4u);
    return v3(value_of_half(first & 65535u), value_of_half(first >> 16),
              value_of_half(second & 65535u));
}

FN vec3 texel_of_singles(SceneTables scene, Uint at) {
    return v3(value_of_single(gather_at_byte(scene.texels, at)),
              value_of_single(gather_at_byte(scene.texels, at + 4u)),
              value_of_single(gather_at_byte(scene.texels, at + 8u)));
}

/// Lanes whose components are of another kind read what the first image begins with; behind a grey
/// texel, and behind the last, stands something.
FN vec3 texel_at(SceneTables scene, Image i, Int x, Int y) {
    vec3 color = splat3(R(0.));
    Uint texel = asUint(y * i.t.width + x);
    Uint at = asUint(i.t.first) * 4u + texel * asUint(i.texel_bytes);
    if (HAS(texels_byte) && someLane(i.bytes)) {
        vec3 found = texel_of_bytes(scene, sel(i.bytes, at, (Uint)0u), i.t.form);
        color = sel3(i.bytes, found, color);
    }
    if (HAS(texels_half) && someLane(i.halves)) {
        vec3 found = texel_of_halves(scene, sel(i.halves, at, (Uint)0u));
        color = sel3(i.halves, found, color);
    }
    if (HAS(texels_single) && someLane(i.singles)) {
        vec3 found = texel_of_singles(scene, sel(i.singles, at, (Uint)0u));
        color = sel3(i.singles, found, color);
    }
    return sel3((i.t.form & TEXTURE_GREY) != 0, splat3(color.x), color);
}

/// Of linear sRGB, as Mitsuba weighs it.
FN Real luminance(vec3 c) { return R(0.212671) * c.x + R(0.715160) * c.y + R(0.072169) * c.z; }

/// One axis of an image: the two texels about a place, and how far it is from the first's centre to
/// the second's.
typedef struct {
    Int low, high;
    Real along;
} TexelPair;

/// The number of a texel that may lie beyond the border by one; of any number one that there is.
FN Int texel_within(Int n, Int size, Mask repeated) {
    Int before = sel(repeated, size - 1, (Int)0), behind = sel(repeated, (Int)0, size - 1);
    return sel(n < 0, before, sel(n >= size, behind, n));
}

/// x: 0 to 1 across the image.
FN TexelPair texel_pair(Real x, Int size, Int form) {
    Mask repeated = TEXTURE_WRAP(form) == 0, mirrored = TEXTURE_WRAP(form) == 1;
    Mask nearest = (form & TEXTURE_NEAREST) != 0;
    Real turn = x - R(2.) * floorR(x * R(.5)); // 0 to 2
    Real within = sel(repeated, x - floorR(x), sel(turn > R(1.), R(2.) - turn, turn));
    Real bordered = sel(x < R(0.), R(0.), sel(x > R(1.), R(1.), x));
    within = sel(repeated | mirrored, within, bordered);
    Real place = within * toReal(size) - sel(nearest, R(0.), R(.5));
    Real floor_of = floorR(place);
    TexelPair p;
    Int low = toInt(floor_of);
    p.low = texel_within(low, size, repeated);
    p.high = texel_within(low + 1, size, repeated);
    // Nothing of the second where they are not interpolated; coordinates that are not finite show.
    p.along = sel(nearest, place * R(0.), place - floor_of);
    return p;
}

/// a where along is 0, and wherever both are the same.
FN vec3 between3(vec3 a, vec3 b, Real along) { return add3(a, scale3(sub3(b, a), along)); }

/// Its number: of a colour its luminance.
FN Real texel_number(SceneTables scene, Image i, Int x, Int y) {
    vec3 color = texel_at(scene, i, x, y);
    return sel((i.t.form & TEXTURE_GREY) != 0, color.x, luminance(color));
}

/// How a coordinate of an image moves what texel_pair makes of it: not where it is not
/// interpolated.
FN Real texels_along(Real x, Int size, Int form) {
    Real turn = x - R(2.) * floorR(x * R(.5));
    Mask back = (TEXTURE_WRAP(form) == 1) & (turn > R(1.));
    Real along = toReal(size) * sel(back, R(-1.), R(1.));
    return sel((form & TEXTURE_NEAREST) != 0, R(0.), along);
}

/// Derivatives of an image's number along u and v of the surface.
FN vec2 bitmap_gradient(SceneTables scene, Texture t, vec2 uv, Mask wanted) {
    Image i = image_of(t, wanted);
    TexelPair x = texel_pair(uv.x, t.width, t.form), y = texel_pair(uv.y, t.height, t.form);
    Real a = texel_number(scene, i, x.low, y.low), b = texel_number(scene, i, x.high, y.low);
    Real c = texel_number(scene, i, x.low, y.high), d = texel_number(scene, i, x.high, y.high);
    Real right = (b - a) + y.along * ((d - c) - (b - a));
    Real down = (c - a) + x.along * ((d - b) - (c - a));
    right = right * texels_along(uv.x, t.width, t.form);
    down = down * texels_along(uv.y, t.height, t.form);
    return v2(t.ux * right + t.vx * down, t.uy * right + t.vy * down);
}

FN vec3 bitmap_color(SceneTables scene, Texture t, vec2 uv, Mask wanted) {
    Image i = image_of(t, wanted);
    TexelPair x = texel_pair(uv.x, t.width, t.form), y = texel_pair(uv.y, t.height, t.form);
    vec3 above =
        between3(texel_at(scene, i, x.low, y.low), texel_at(scene, i, x.high, y.low), x.along);
    vec3 below =
        between3(texel_at(scene, i, x.low, y.high), texel_at(scene, i, x.high, y.high), x.along);
    return between3(above, below, y.along);
}

/// Whether the place is on a square of the first colour; what lies on a border belongs to the
/// square before it.
FN Mask checkerboard_first(vec2 uv) {
    Mask right = uv.x - floorR(uv.x) > R(.5), below = uv.y - floorR(uv.y) > R(.5);
    return !((right & !below) | (below & !right));
}
FN vec3 checkerboard_color(Texture t, Mask first) {
    return sel3(first, v3(t.r0, t.g0, t.b0), v3(t.r1, t.g1, t.b1));
}

/// Where on a surface a texture is looked up.
typedef struct {
    vec2 uv;
    Int primitive, shape; // their numbers
    Real b1, b2;          // barycentrics of a triangle
    vec3 du, dv;          // in the surface's frame, where heights tilt normals
} TexturePlace;

/// Three floats from each lane's word on.
FN vec3 load_color(global const int* words, Int first) {
    global const float* values = (global const float*)words;
    return v3(gather(values, first), gather(values + 1, first), gather(values + 2, first));
}

FN vec3 mesh_attribute_color(SceneTables scene, Texture t, TexturePlace place, Mask mine) {
    Int first = gather_int(scene.texels, sel(mine, t.first + place.shape, (Int)0));
    Mask faces = (t.form & TEXTURE_OF_FACES) != 0;
    Int word = first + place.primitive * sel(faces, (Int)3, (Int)9);
    word = sel(mine, word, (Int)0);
    vec3 a = load_color(scene.texels, word);
    if (!someLane(mine & !faces)) return a;
    Int next = sel(mine & !faces, word + 3, word), last = sel(mine & !faces, word + 6, word);
    vec3 between = interpolate3(a, load_color(scene.texels, next), load_color(scene.texels, last),
                                place.b1, place.b2);
    return sel3(faces, a, between);
}

FN Texture load_wanted_texture(SceneTables scene, Int row, Mask wanted) {
    return load_Texture(scene.textures, sel(wanted, row, (Int)0));
}
FN vec2 texture_uv(Texture t, vec2 uv) {
    return v2(t.ux * uv.x + t.uy * uv.y + t.ut, t.vx * uv.x + t.vy * uv.y + t.vt);
}

/// The colour of texture `row` at a place of the surface; lanes that are not wanted get some
/// numbers.
FN vec3 texture_color(SceneTables scene, Int row, TexturePlace place, Mask wanted) {
    Texture t = load_wanted_texture(scene, row, wanted);
    vec2 uv = texture_uv(t, place.uv);
    vec3 color = splat3(R(0.));
    if (HAS(texture_bitmap)) {
        Mask mine = wanted & (TEXTURE_KIND(t.form) == texture_bitmap);
        if (someLane(mine)) color = bitmap_color(scene, t, uv, mine);
    }
    if (HAS(texture_checkerboard)) {
        Mask mine = TEXTURE_KIND(t.form) == texture_checkerboard;
        color = sel3(mine, checkerboard_color(t, checkerboard_first(uv)), color);
    }
    if (HAS(texture_mesh_attribute)) {
        Mask mine = wanted & (TEXTURE_KIND(t.form) == texture_mesh_attribute);
        if (someLane(mine)) color = sel3(mine, mesh_attribute_color(scene, t, place, mine), color);
    }
    return color;
}

/// The number that texture `row` is there: of an image its luminance, of a colour that a
/// checkerboard has the mean of its channels. A checkerboard is the other way about than its
/// colours are, as in Mitsuba 3 (eval_1 and eval of its `checkerboard`).
FN Real texture_number(SceneTables scene, Int row, TexturePlace place, Mask wanted) {
    Texture t = load_wanted_texture(scene, row, wanted);
    vec2 uv = texture_uv(t, place.uv);
    Real number = R(0.);
    if (HAS(texture_bitmap)) {
        Mask mine = wanted & (TEXTURE_KIND(t.form) == texture_bitmap);
        if (someLane(mine)) {
            vec3 color = bitmap_color(scene, t, uv, mine);
            number = sel((t.form & TEXTURE_GREY) != 0, color.x, luminance(color));
        }
    }
    if (HAS(texture_checkerboard)) {
        Mask mine = TEXTURE_KIND(t.form) == texture_checkerboard;
        vec3 color = checkerboard_color(t, !checkerboard_first(uv));
        number = sel(mine, (color.x + color.y + color.z) / R(3.), number);
    }
    if (HAS(texture_mesh_attribute)) {
        Mask mine = wanted & (TEXTURE_KIND(t.form) == texture_mesh_attribute);
        if (someLane(mine)) {
            vec3 color = mesh_attribute_color(scene, t, place, mine);
            Real grey = sel((t.form & TEXTURE_GREY) != 0, color.x, luminance(color));
            number = sel(mine, grey, number);
        }
    }
    return number;
}

FN vec3 textured_color(SceneTables scene, Int row, TexturePlace place, Mask hit, vec3 otherwise) {
    Mask wanted = hit & (row >= 0);
    if (!someLane(wanted)) return otherwise;
    return sel3(wanted, texture_color(scene, row, place, wanted), otherwise);
}

#endif
