// What all kernels of a render are told.
#include "host/waves/render_params.h"

#include "host/flatten/camera_record.h"
#include "host/flatten/scene_features.h"

#include <algorithm>
#include <bit>

namespace parhelion {

RenderParams render_params(const Scene& scene, const DeviceScene& device, const WorkSizes& sizes,
                           const AovPlan& aovs) {
    RenderParams p{};
    p.camera = camera_record(scene.camera, scene.film.width, scene.film.height, device.frame);
    p.film_width = scene.film.width, p.film_height = scene.film.height;
    p.sample_border = scene.film.sample_border;
    const SampleWindow& window = sizes.film.window;
    p.pixel_stride = window.pixel_stride;
    p.window_x = window.x, p.window_y = window.y;
    p.window_width = window.width, p.window_height = window.height;
    p.block_x = window.block_x, p.block_y = window.block_y;
    p.blocks_x = window.blocks_x;
    p.filter_reach = window.reach;
    p.seed = static_cast<int>(scene.sampler.seed);
    p.replicate_bits = std::countr_zero(static_cast<unsigned>(scene.sampler.replicates));
    p.max_depth = longest_path(scene.integrator);
    p.rr_depth = scene.integrator.rr_depth;
    p.sky_light = device.sky_light;
    p.sky_texture = device.environment.texture;
    // As in Mitsuba 3: a visible sky is part of the picture to `path`, and behind it to `direct`.
    // One of no power is there too.
    p.sky_covers = scene.integrator.kind == IntegratorKind::path &&
                   !scene.integrator.hide_emitters &&
                   std::any_of(scene.emitters.begin(), scene.emitters.end(), is_sky);
    p.filter_bins =
        device.filter_table.empty() ? 0 : static_cast<int>(device.filter_table.size()) - 1;
    p.result_stride = static_cast<int>(sizes.result_stride());
    p.state_stride = static_cast<int>(sizes.state_stride());
    p.segment_size = sizes.segment_size;
    p.segment_stride = sizes.segment_stride;
    p.film_stride = static_cast<int>(sizes.film.stride());
    p.aov_channels = sizes.film.aov_channels;
    p.camera_root = device.camera_root;
    p.root = device.root;
    p.blocking_root = device.blocking_root;
    p.clear_root = device.clear_root;
    p.tree_sizes = {bvh_extent(device.bvh, device.root), device.bvh.side};
    std::fill(std::begin(p.aov_offset), std::end(p.aov_offset), -1);
    for (const AovLayer& layer : aovs.layers)
        p.aov_offset[layer.kind] = layer.channel;
    return p;
}

} // namespace parhelion
