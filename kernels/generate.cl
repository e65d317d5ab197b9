// Generate: the camera rays of a wave.
#include "device/device.h"

#include "device/camera_lanes.h"
#include "device/results.h"
#include "device/state.h"
#include "device/wave.h"

typedef struct {
    Real offset, weight;
} FilterSample;

/// Offset from the pixel's centre along one axis, distributed as the absolute value of the
/// reconstruction filter (filter importance sampling, Ernst, Stamminger and Greiner 2006): a sample
/// then belongs to one pixel only.
FN FilterSample filter_sample(global const FilterBin* table, int bins, Real u) {
    FilterSample s;
    s.offset = u - .5f;
    s.weight = R(1.);
    if (HAS(filter_sampling)) {
        Real scaled = u * (float)bins;
        Int bin = toInt(scaled);
        Real begin = gather((global const float*)table, bin * 2);
        Real end = gather((global const float*)table, bin * 2 + 2);
        s.offset = begin + (end - begin) * (scaled - toReal(bin));
        s.weight = gather((global const float*)table, bin * 2 + 1);
    }
    return s;
}

/// A sample on the film: the pixel that it is of, and its offset from the centre there.
typedef struct {
    Mask valid; // on the film, and wanted
    Int x, y, pixel;
    vec2 offset;
    Real weight; // 0 where not valid
} FilmSample;

/// The pixels that `s` is of, which lie in a block.
FN FilmSample slot_pixels(RenderParams params, int block, SlotSample s) {
    FilmSample f;
    f.x = params.block_x + block % params.blocks_x * BLOCK_SIDE + s.x;
    f.y = params.block_y + block / params.blocks_x * BLOCK_SIDE + s.y;
    f.valid = (f.x >= params.window_x) & (f.x < params.window_x + params.window_width) &
              (f.y >= params.window_y) & (f.y < params.window_y + params.window_height);
    f.pixel = f.y * params.pixel_stride + f.x;
    return f;
}

FN vec2 film_position(FilmSample f) {
    return v2(toReal(f.x) + .5f + f.offset.x, toReal(f.y) + .5f + f.offset.y);
}

/// Takes the place in the pixel, by two random numbers.
FN FilmSample placed(FilmSample f, RenderParams params, global const FilterBin* table, Real u,
                     Real v) {
    FilterSample x = filter_sample(table, params.filter_bins, u);
    FilterSample y = filter_sample(table, params.filter_bins, v);
    f.offset = v2(x.offset, y.offset);
    if (HAS(filter_sampling) && !params.sample_border) {
        // A wide filter reaches over the edge of the film: what lies there is no part of the
        // picture.
        vec2 at = film_position(f);
        f.valid = f.valid & (at.x >= 0.f) & (at.x <= (float)params.film_width) & (at.y >= 0.f) &
                  (at.y <= (float)params.film_height);
    }
    f.weight = sel(f.valid, x.weight * y.weight, R(0.));
    return f;
}

/// Nothing gathered yet by the slots from `slot` on.
FN void clear_results(Results results, RenderParams params, int slot, Real weight, vec2 offset) {
    int channels = AOV_CHANNEL(params.aov_channels);
    for (int channel = 0; channel < channels; channel++)
        STORE_REAL(result_channel(results, channel) + slot, (Real)0.f);
    STORE_REAL(result_channel(results, result_weight) + slot, weight);
    if (HAS(filter_splatting)) {
        STORE_REAL(result_channel(results, channels) + slot, offset.x);
        STORE_REAL(result_channel(results, channels + 1) + slot, offset.y);
    }
    if (HAS(shape_ids)) {
        int shape = SHAPE_CHANNEL(params.aov_channels, HAS(filter_splatting));
        STORE_REAL(result_channel(results, shape) + slot, (Real)0.f);
    }
}

FN Path camera_path(CameraRay ray, Int slot, Int pixel, Int sample) {
    Path p;
    p.origin = ray.origin;
    p.direction = ray.direction;
    p.t = ray.t_max;
    p.excluded = (Int)(-1);
    p.throughput = splat3(R(1.));
    p.pdf = (Real)INFINITY; // emission met by a camera ray has no other strategy
    p.eta_scale = R(1.);
    p.scattered_at = ray.origin;
    p.slot = slot;
    p.pixel = pixel;
    p.sample = sample;
    return p;
}

/// Reads: the wave's blocks, camera, filter table. Writes: results (cleared), counts, path state.
/// Pushes: one path a valid pixel and sample.
kernel void generate(KERNEL_PARAMETERS) {
    CHECK_BOUNDS();
    int segment = get_global_id(0);
    int first = segment * params.segment_size;
    int last = min(first + params.segment_size, wave_paths(wave));
    int to = segment * params.segment_stride, begin = to;
    Camera camera = camera_lanes(params.camera);
    for (int slot = first; slot < last; slot += LANES) {
        WaveBlock block = wave_block(wave_blocks, slot_block(wave, slot));
        SlotSample s = slot_sample(wave, block.first_sample, slot);
        FilmSample film_sample = slot_pixels(params, block.block, s);
        SampleNumber number = sample_number(asUint(film_sample.pixel), asUint(s.sample),
                                            (Uint)(uint)params.seed, params.replicate_bits);
        Random4 random = sampler_draw(number, (Uint)(uint)draw_camera);
        film_sample =
            placed(film_sample, params, filter_table, uniform01(random.x), uniform01(random.y));
        vec2 lens = v2(R(0.), R(0.));
        if (HAS(thin_lens)) lens = disk_uniform(uniform2(random.z, random.w));
        CameraRay ray = camera_ray(camera, film_position(film_sample), lens);
        // As mark_bad does, with what its alpha then says: 0, no bounce and the first of the
        // faults.
        Mask bad = film_sample.valid & (nought3(ray.origin) + nought3(ray.direction) != R(0.));
        clear_results(results_of(results, params), params, slot,
                      sel(bad, (Real)NAN, film_sample.weight), film_sample.offset);
        Path path = camera_path(ray, (Int)slot + LANE_INDEX, film_sample.pixel, s.sample);
        to += pack_path(state_place(path_state, params.state_stride, to), path,
                        maskBits(film_sample.valid));
    }
    AT(global int, counts, 2 * segment) = to - begin;
    AT(global ulong, statistics, statistic_count * segment + statistic_camera_rays) +=
        (ulong)(to - begin);
}
