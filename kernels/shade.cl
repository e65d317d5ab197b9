// Shade: what a path does at the surface (or the sky) it reached.
#include "device/device.h"

#include "device/shade_aovs.h"
#include "device/shade_light.h"
#include "device/shade_scatter.h"
#include "device/shade_see.h"

/// Reads: path state, scene. Writes: results (emission, alpha, AOVs and shape at the first vertex),
/// counts, path and shadow state. Pushes: a shadow ray for each vertex with light to receive, a
/// path for each that goes on; both packed in place.
kernel void shade(KERNEL_PARAMETERS) {
    CHECK_BOUNDS();
    int segment = get_global_id(0);
    int base = segment * params.segment_stride;
    int end = base + AT(global int, counts, 2 * segment);
    long stride = params.state_stride;
    ShadeWork w = {{SCENE_BUFFERS(SCENE_VALUE)}, &params, results_of(results, params), depth};
    int next_path = base, next_shadow = base;
    for (int at = base; at < end; at += LANES) {
        PathVertex v = load_vertex(state_place(path_state, stride, at), end - at, w.scene);
        see(w, v);
        Shading s = shading_at(w, v);
        if (HAS(aovs) && depth == 0) write_aovs(w, v, s);
        if (HAS(shape_ids) && depth == 0) write_shape(w, v);
        s = pass_or_cover(w, v, s);
        if (depth + 1 >= params.max_depth) continue;
        s = turned_to_viewer(w, v, s);
        if (HAS(next_event))
            next_shadow += cast_shadow_rays(w, v, s, direct_light(w, v, s),
                                            state_place(shadow_state, stride, next_shadow));
        // Where rays meet no light and cover nothing, the last one is of no use.
        int useful = HAS(emission) || HAS(straight_through) || depth + 2 < params.max_depth;
        if (HAS(scattering) && useful)
            next_path += continue_paths(w, v, s, scattered(w, v, s),
                                        state_place(path_state, stride, next_path));
    }
    AT(global int, counts, 2 * segment) = next_path - base;
    AT(global int, counts, 2 * segment + 1) = next_shadow - base;
}
