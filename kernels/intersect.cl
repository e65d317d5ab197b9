// Intersect: the closest hit of every live path.
#include "device/device.h"
#include "device/lanes_memory.h"
#include "device/path_state.h"
#include "device/traverse.h"

/// Reads: path state (ray, t as its end, excluded). Writes: path state (t, b1, b2, primitive).
kernel void intersect(KERNEL_PARAMETERS) {
    int segment = get_global_id(0);
    int base = segment * params.segment_stride;
    int end = base + counts[2 * segment];
    int root = depth == 0 ? params.camera_root : params.root;
    for (int at = base; at < end; at++) {
        TraversalRay ray = traversal_ray(PATH_AT(ox), PATH_AT(oy), PATH_AT(oz), PATH_AT(dx),
                                         PATH_AT(dy), PATH_AT(dz));
        RayHit hit =
            traverse(bvh_nodes, bvh_leaves, root, &ray, PATH_AT(t), PATH_INT_AT(excluded), 0);
        PATH_AT(t) = hit.t;
        PATH_AT(b1) = hit.b1;
        PATH_AT(b2) = hit.b2;
        PATH_INT_AT(primitive) = hit.primitive;
    }
    if (depth > 0)
        statistics[statistic_count * segment + statistic_bounce_rays] += (ulong)(end - base);
}
