// Generate: the camera rays of a wave.
#include "device/device.h"
#include "device/lanes_memory.h"
#include "device/path_state.h"
#include "device/wave.h"

#include "device/bad_sample.h"
#include "device/camera_lanes.h"

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

/// Reads: camera, filter table. Writes: results (cleared), counts, path state. Pushes: one path a
/// valid pixel and sample.
kernel void generate(KERNEL_PARAMETERS) {
    CHECK_BOUNDS();
    int segment = get_global_id(0);
    int first = segment * params.segment_size;
    int last = min(first + params.segment_size, wave_paths(wave));
    int to = segment * params.segment_stride, begin = to;
    Camera camera = camera_lanes(params.camera);
    for (int slot = first; slot < last; slot += LANES) {
        int block = slot_block(wave, slot);
        SlotSample s = slot_sample(wave, slot);
        Int x = params.block_x + block % params.blocks_x * 4 + s.x;
        Int y = params.block_y + block / params.blocks_x * 4 + s.y;
        Mask valid = (x >= params.window_x) & (x < params.window_x + params.window_width) &
                     (y >= params.window_y) & (y < params.window_y + params.window_height);
        Int pixel = y * params.pixel_stride + x;
        SampleNumber number = sample_number(asUint(pixel), asUint(s.sample),
                                            (Uint)(uint)params.seed, params.replicate_bits);
        Random4 random = sampler_draw(number, (Uint)(uint)draw_camera);
        FilterSample fx = filter_sample(filter_table, params.filter_bins, uniform01(random.x));
        FilterSample fy = filter_sample(filter_table, params.filter_bins, uniform01(random.y));
        vec2 film_position = v2(toReal(x) + .5f + fx.offset, toReal(y) + .5f + fy.offset);
        Real weight = fx.weight * fy.weight;
        if (HAS(filter_sampling) && !params.sample_border) {
            // A wide filter reaches over the edge of the film: what lies there is no part of the
            // picture.
            Mask on_film =
                (film_position.x >= 0.f) & (film_position.x <= (float)params.film_width) &
                (film_position.y >= 0.f) & (film_position.y <= (float)params.film_height);
            valid = valid & on_film;
        }
        weight = sel(valid, weight, R(0.));
        vec2 lens = v2(R(0.), R(0.));
        if (HAS(thin_lens)) lens = disk_uniform(uniform2(random.z, random.w));
        CameraRay ray = camera_ray(camera, film_position, lens);
        // As mark_bad does, with what its alpha then says: 0, no bounce and the first of the
        // faults.
        Mask bad = valid & (nought3(ray.origin) + nought3(ray.direction) != R(0.));
        weight = sel(bad, (Real)NAN, weight);

        int channels = result_field_count + params.aov_channels;
        for (int channel = 0; channel < channels; channel++)
            STORE_REAL(RESULT(channel) + slot, (Real)0.f);
        STORE_REAL(RESULT(result_weight) + slot, weight);
        if (HAS(filter_splatting)) {
            STORE_REAL(RESULT(channels) + slot, fx.offset);
            STORE_REAL(RESULT(channels + 1) + slot, fy.offset);
        }

        uint bits = maskBits(valid);
        PATH_PACK_REAL(ox, ray.origin.x);
        PATH_PACK_REAL(oy, ray.origin.y);
        PATH_PACK_REAL(oz, ray.origin.z);
        PATH_PACK_REAL(dx, ray.direction.x);
        PATH_PACK_REAL(dy, ray.direction.y);
        PATH_PACK_REAL(dz, ray.direction.z);
        PATH_PACK_REAL(t, ray.t_max);
        PATH_PACK_REAL(tr, (Real)1.f);
        PATH_PACK_REAL(tg, (Real)1.f);
        PATH_PACK_REAL(tb, (Real)1.f);
        PATH_PACK_REAL(pdf, (Real)INFINITY); // emission met by a camera ray has no other strategy
        PATH_PACK_REAL(eta_scale, (Real)1.f);
        PATH_PACK_INT(slot, (Int)slot + LANE_INDEX);
        PATH_PACK_INT(pixel, pixel);
        PATH_PACK_INT(sample, s.sample);
        PATH_PACK_INT(excluded, (Int)(-1));
        to += popcount(bits);
    }
    AT(global int, counts, 2 * segment) = to - begin;
    AT(global ulong, statistics, statistic_count * segment + statistic_camera_rays) +=
        (ulong)(to - begin);
}
