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
                plain_walk({SCENE_BUFFERS(SCENE_VALUE)}, params.root,
                           packet_ray(ray_at_origin(place), ray_at_direction(place), sizes),
                           ray_at_t(place), ray_at_excluded(place), true);
            add_result3(results_of(results, params), result_r, shadow_at_slot(place),
                        shadow_at_contribution(place), hit.primitive < 0);
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
