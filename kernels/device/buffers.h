// The lists of what kernels read and write, each buffer written once; kernel signatures, allocation
// and binding follow.
//
// All kernels have the same parameters, KERNEL_PARAMETERS: the host binds them once, and a kernel
// takes what it needs.
#ifndef PARHELION_BUFFERS_H
#define PARHELION_BUFFERS_H

#include "shared/types.h"

// A wave: as many samples of each of its blocks, of which WaveBlock says which. The film there is
// has the tiles from that of block film_first on. Which sample a slot of the pool is, wave.h says.
typedef struct {
    int block_count, sample_count;
    int film_first, unused;
} WaveParams;
LAYOUT(WaveParams, 16);

// A block, by its number in the sampled window, and its first sample in a wave.
typedef struct {
    int block, first_sample;
} WaveBlock;
LAYOUT(WaveBlock, 8);

// The lists below are tables.
// clang-format off

// element type, name: the scene, read only
#define SCENE_BUFFERS(X)                                                                           \
    X(BvhNode, bvh_nodes) X(BvhLine, bvh_leaves)                                                   \
    X(IndexedPrimitiveRecord, primitives) X(float, points) X(ShapeRecord, shapes)                  \
    X(MaterialRecord, materials) X(LobeRecord, lobes)                                              \
    X(MaterialTexturesRecord, material_textures) X(TextureRecord, textures)                        \
    X(int, texels) /* of images, one behind the other */                                           \
    X(float, byte_values) X(LightRecord, lights) X(int, light_textures) /* LIGHT_TEXTURE_WORDS a row */ \
    X(LightNodeRecord, light_nodes) X(int, light_leaves) /* the leaf of each light */              \
    X(int, light_groups) /* of each row of the light table: first channel of results of its group */ \
    X(int, environment) /* of a sky: environment.h, and words before that: daylight.h */           \
    X(float, energy_tables)                                                                        \
    X(FilterBin, filter_table) X(float, filter_values) /* at n / FILTER_INTERVALS pixels */

// Of a row of the light table, where some light has a texture: the row of that, which tells what its radiance is multiplied by (-1:
// nothing), the first primitive that shines, and how many do. Of a light without size, 0 of them: the word behind all rows where
// FRAME_WORDS floats begin, of the frame that it shines through: what frame_place knows as across and aspect.
#define LIGHT_TEXTURE_WORDS 3
#define FRAME_WORDS 4

// Words of a sunsky before its table of shares, floats: direction of the sun in the sky's frame; how far the edge of its disk is from its
// middle, the square of the chord; of 256 directions how many are chosen by the table; radiance of the sun; of red, green and blue the
// coefficients A to I of the sky in the formula's order, and the radiance that it scales.
#define DAYLIGHT_SUN_DIRECTION 0
#define DAYLIGHT_SUN_EDGE 3
#define DAYLIGHT_SKY_SHARE 4
#define DAYLIGHT_SUN_RADIANCE 5
#define DAYLIGHT_SKY 8
#define DAYLIGHT_SKY_FIELDS(X) X(a) X(b) X(c) X(d) X(e) X(f) X(g) X(i) X(h) X(radiance)
#define DAYLIGHT_SKY_WORDS 10
#define DAYLIGHT_WORDS (DAYLIGHT_SKY + 3 * DAYLIGHT_SKY_WORDS)

// element type, name: what a render works on
//   path_state    words of PATH_FIELDS x state_stride: live paths, packed at the front of each segment
//   shadow_state  words of SHADOW_FIELDS x state_stride: shadow rays, likewise
//   results       RESULT_CHANNELS x result_stride: what each path slot has gathered
//   wave_blocks   what the wave has samples of
//   counts        2 a segment: live paths, shadow rays
//   statistics    STATISTICS and FAULTS a segment
//   bad_samples   BAD_SAMPLE_FIELDS a block of the film: its first sample that was not finite
//   film          FILM_CHANNELS x EXACT_WORDS x film_stride: the digits of sums (exact_sum.h); each
//                 holds a tile a block
#define WAVE_BUFFERS(X)                                                                            \
    X(float, path_state) X(float, shadow_state) X(float, results)                                  \
    X(WaveBlock, wave_blocks) X(int, counts) X(ulong, statistics) X(int, bad_samples)
#define WORK_BUFFERS(X) WAVE_BUFFERS(X) X(uint, film)

// The lists of states: type of a field in a lane, name, whether anything needs it.

// A ray; t: its end, and once it has hit, how far; what it must not hit.
#define RAY_FIELDS(X) X(vec3, origin, 1) X(vec3, direction, 1) X(Real, t, 1) X(Int, excluded, 1)

// What a path takes along: throughput, density of its direction, product of the indices of refraction, its slot, its random numbers;
// where it was last scattered, which is its origin but for what it has met since that was not there.
#define CARRIED_FIELDS(X)                                                                          \
    X(vec3, throughput, 1) X(Real, pdf, HAS(emission)) X(Real, eta_scale, HAS(russian_roulette))    \
    X(Int, slot, 1) X(Int, pixel, 1) X(Int, sample, 1) X(vec3, scattered_at, HAS(clear_shadows) && HAS(emission))

// What its ray has hit, and where on that.
#define HIT_FIELDS(X) X(Real, b1, 1) X(Real, b2, 1) X(Int, primitive, 1)

// What a shadow ray brings where nothing is in its way, and the channel of the group of its light.
#define BROUGHT_FIELDS(X) X(vec3, contribution, 1) X(Int, slot, 1) X(Int, group, HAS(light_groups))

#define PATH_FIELDS(X) RAY_FIELDS(X) CARRIED_FIELDS(X) HIT_FIELDS(X)
#define SHADOW_FIELDS(X) RAY_FIELDS(X) BROUGHT_FIELDS(X) X(Int, blocked, HAS(ray_streams))

// What a path slot gathers, and the film sums up.
#define RESULT_FIELDS(X) X(float, r) X(float, g) X(float, b) X(float, alpha) X(float, weight)

// With g the square of a sample's weight: sum of g; and of r, g, b each sums of g x and g x^2.
#define SPREAD_CHANNELS(X) X(weight) X(first_r) X(first_g) X(first_b) X(second_r) X(second_g) X(second_b)

// Channels of results and film, behind each other: RESULT_FIELDS, `aovs` channels of AOVs, light groups among them; then of results, if
// HAS(filter_splatting), the sample's offset from the centre of its pixel, x and y, and if HAS(shape_ids), 1 more than the shape that
// its camera ray has met, 0 for none; of the film, if HAS(moments), the squares of
// r, g, b, and if HAS(variance), SPREAD_CHANNELS.
#define AOV_CHANNEL(channel) (result_field_count + (channel))
#define SHAPE_CHANNEL(aovs, splatted) (AOV_CHANNEL(aovs) + ((splatted) ? 2 : 0))
#define RESULT_CHANNELS(aovs, splatted, shape_ids) (SHAPE_CHANNEL(aovs, splatted) + ((shape_ids) ? 1 : 0))
#define SQUARE_CHANNEL(aovs) AOV_CHANNEL(aovs)
#define SPREAD_CHANNEL(aovs, moments) (SQUARE_CHANNEL(aovs) + ((moments) ? 3 : 0))
#define FILM_CHANNELS(aovs, moments, variance) (SPREAD_CHANNEL(aovs, moments) + ((variance) ? (int)spread_channel_count : 0))

// What can go wrong with a sample, and the stage that finds it: numbers that are not finite in its camera ray, where a ray has
// hit, its AOVs, what it sees, what it gets from a light, its next direction and throughput, and the sum of all it has gathered.
#define FAULTS(X)                                                                                  \
    X(camera_ray, generate) X(hit, shade) X(aov, shade) X(emission, shade) X(next_event, shade)    \
    X(bsdf, shade) X(sum, accumulate)

// Beside these a count for each fault.
#define STATISTICS(X) X(camera_rays) X(bounce_rays) X(shadow_rays)

// Pixels count from the top left corner of the film; bounce -1: unknown.
#define BAD_SAMPLE_FIELDS(X) X(known) X(sample) X(x) X(y) X(fault) X(bounce)

// Numbers of words, of a vector's first.
#define WORDS_Real(name) name,
#define WORDS_Int(name) name,
#define WORDS_vec3(name) name, name##_y, name##_z,
#define RAY_WORD(type, name, needed) WORDS_##type(ray_##name)
enum RayWord { RAY_FIELDS(RAY_WORD) ray_word_count };
#define PATH_WORD(type, name, needed) WORDS_##type(path_##name)
enum PathWord { PATH_FIELDS(PATH_WORD) path_word_count };
#define SHADOW_WORD(type, name, needed) WORDS_##type(shadow_##name)
enum ShadowWord { SHADOW_FIELDS(SHADOW_WORD) shadow_word_count };
#define RESULT_ENUM(type, name) result_##name,
enum ResultField { RESULT_FIELDS(RESULT_ENUM) result_field_count };
#define SPREAD_ENUM(name) spread_##name,
enum SpreadChannel { SPREAD_CHANNELS(SPREAD_ENUM) spread_channel_count };
#define STATISTIC_ENUM(name) statistic_##name,
#define FAULT_ENUM(name, stage) fault_##name,
enum Fault { FAULTS(FAULT_ENUM) fault_count };
enum Statistic {
    STATISTICS(STATISTIC_ENUM) statistic_first_fault, // a count for each Fault
    statistic_count = statistic_first_fault + fault_count
};
#define BAD_SAMPLE_ENUM(name) bad_sample_##name,
enum BadSampleField { BAD_SAMPLE_FIELDS(BAD_SAMPLE_ENUM) bad_sample_field_count };

// A segment has this many spare entries behind it where lanes are many: a packed store overwrites them.
#define SEGMENT_PADDING 16

// clang-format on

#endif
