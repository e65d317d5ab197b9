// The kernels as C++ in double precision: the text that OpenCL compiles, but for tracing, which is
// plain here.
//
// Records are the device's, read exactly; random numbers are the same 24 bits. So a path takes the
// way it takes in single precision, but where rounding decides.
#include "host/oracle/run_stage.h"
#include "host/oracle/work_item.h"

#include <array>
#include <functional>

#include "host/oracle/opencl_names.h"

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

#include "host/oracle/plain_walk.h"
#undef PARHELION_REAL
#undef PARHELION_REAL_IS_DOUBLE

    void intersect(KERNEL_PARAMETERS) {
        int base = number * params.segment_stride, end = base + AT(int, counts, 2 * number);
        int root = depth == 0 ? params.camera_root : params.root;
        for (int at = base; at < end; at++) {
            PacketRay ray = packet_ray(
                v3(PATH_LOAD_REAL(ox), PATH_LOAD_REAL(oy), PATH_LOAD_REAL(oz)),
                v3(PATH_LOAD_REAL(dx), PATH_LOAD_REAL(dy), PATH_LOAD_REAL(dz)), tree_sizes(params));
            PlainHit hit = plain_walk(bvh_nodes, bvh_leaves, primitives, root, ray,
                                      PATH_LOAD_REAL(t), PATH_LOAD_INT(excluded), false);
            PATH_STORE_REAL(t, hit.t);
            PATH_STORE_REAL(b1, hit.b1);
            PATH_STORE_REAL(b2, hit.b2);
            PATH_STORE_INT(primitive, hit.primitive);
        }
        if (depth > 0)
            AT(ulong, statistics, statistic_count * number + statistic_bounce_rays) +=
                static_cast<ulong>(end - base);
    }

    void shadow(KERNEL_PARAMETERS) {
        int base = number * params.segment_stride, end = base + AT(int, counts, 2 * number + 1);
        for (int at = base; at < end; at++) {
            PacketRay ray =
                packet_ray(v3(SHADOW_LOAD_REAL(ox), SHADOW_LOAD_REAL(oy), SHADOW_LOAD_REAL(oz)),
                           v3(SHADOW_LOAD_REAL(dx), SHADOW_LOAD_REAL(dy), SHADOW_LOAD_REAL(dz)),
                           blocking_sizes(params));
            PlainHit hit = plain_walk(bvh_nodes, bvh_leaves, primitives, params.root, ray,
                                      SHADOW_LOAD_REAL(t), SHADOW_LOAD_INT(excluded), true);
            vec3 light = v3(SHADOW_LOAD_REAL(r), SHADOW_LOAD_REAL(g), SHADOW_LOAD_REAL(b));
            add_result3(results, params.result_stride, result_r, SHADOW_LOAD_INT(slot), light,
                        hit.primitive < 0);
        }
        AT(ulong, statistics, statistic_count * number + statistic_shadow_rays) +=
            static_cast<ulong>(end - base);
    }
};

} // namespace

void run_work_item(Stage stage, const HostLaunch<double>& launch, int depth, int number) {
    auto buffers = buffer_ranges(launch);
    Kernels kernels{{launch.features, number, buffers}};
    run_stage(kernels, stage, launch, depth);
}

} // namespace parhelion

#include "host/oracle/opencl_names_end.h"
