// The kernels as C++ in double precision: the text that OpenCL compiles, but for tracing, which is
// plain here.
//
// Records are the device's, read exactly; random numbers are the same 24 bits. So a path takes the
// way it takes in single precision, but where rounding decides.
#include "host/bvh/leaf_reader.h"
#include "host/twin/run_stage.h"
#include "host/twin/work_item.h"

#include <array>
#include <functional>

#include "host/twin/opencl_names.h"

namespace parhelion {
namespace {

struct Kernels : WorkItem {
#define PARHELION_REAL double
#define PARHELION_REAL_IS_DOUBLE
#include "kernels/accumulate.cl"
#include "kernels/generate.cl"
#include "kernels/shade.cl"
// And of tracing:
#include "device/traversal_ray.h"

#include "host/twin/plain_walk.h"
#undef PARHELION_REAL
#undef PARHELION_REAL_IS_DOUBLE

    Path path_to_clear(const SceneTables& scene, const RenderParams& params, Path p, bool) {
        PlainHit hit = plain_walk(scene, params.clear_root,
                                  packet_ray(p.origin, p.direction, params.tree_sizes), p.t,
                                  p.excluded, false);
        p.t = hit.t, p.b1 = hit.b1, p.b2 = hit.b2, p.primitive = hit.primitive;
        return p;
    }
#include "device/shadow_clear.h"

    void intersect(KERNEL_PARAMETERS) {
        int base = number * params.segment_stride, end = base + AT(int, counts, 2 * number);
        int root = depth == 0 ? params.camera_root : params.root;
        TreeSizes sizes = params.tree_sizes;
        for (int at = base; at < end; at++) {
            StatePlace place = state_place(path_state, params.state_stride, at);
            PlainHit hit =
                plain_walk({SCENE_BUFFERS(SCENE_VALUE)}, root,
                           packet_ray(ray_at_origin(place), ray_at_direction(place), sizes),
                           ray_at_t(place), ray_at_excluded(place), false);
            store_hit(place, hit.t, hit.b1, hit.b2, hit.primitive);
        }
        if (depth > 0)
            AT(ulong, statistics, statistic_count * number + statistic_bounce_rays) +=
                static_cast<ulong>(end - base);
    }

    void shadow(KERNEL_PARAMETERS) {
        int base = number * params.segment_stride, end = base + AT(int, counts, 2 * number + 1);
        TreeSizes sizes = blocking_sizes(params);
        for (int at = base; at < end; at++) {
            StatePlace place = state_place(shadow_state, params.state_stride, at);
            PlainHit hit =
                plain_walk({SCENE_BUFFERS(SCENE_VALUE)}, params.blocking_root,
                           packet_ray(ray_at_origin(place), ray_at_direction(place), sizes),
                           ray_at_t(place), ray_at_excluded(place), true);
            bool blocked = hit.primitive >= 0;
            vec3 light = shadow_at_contribution(place);
            if (!blocked && FEATURES.has(feature_clear_shadows)) {
                double share = clear_way({SCENE_BUFFERS(SCENE_VALUE)}, params, place, true, depth);
                light = scale3(light, share);
                blocked = !(share > 0);
            }
            add_result3(results_of(results, params), result_r, shadow_at_slot(place), light,
                        !blocked);
            if (FEATURES.has(feature_light_groups))
                add_result3_by_lane(results_of(results, params), shadow_at_group(place),
                                    shadow_at_slot(place), light, !blocked);
        }
        AT(ulong, statistics, statistic_count * number + statistic_shadow_rays) +=
            static_cast<ulong>(end - base);
    }
};

} // namespace

void run_work_item(Stage stage, const HostLaunch<double>& launch, int depth, int number) {
    run_by<Kernels>(stage, launch, depth, number);
}

} // namespace parhelion

#include "host/twin/opencl_names_end.h"
