// Shadow: what next event estimation found arrives, unless something is in the way.
#include "device/device.h"
#include "device/lanes_memory.h"
#include "device/path_state.h"
#include "device/traverse.h"

/// Reads: shadow state. Writes: results (r, g, b of the ray's own path slot; no other work-item has
/// it).
kernel void shadow(KERNEL_PARAMETERS) {
    int segment = get_global_id(0);
    int base = segment * params.segment_stride;
    int end = base + counts[2 * segment + 1];
    for (int at = base; at < end; at++) {
        TraversalRay ray = traversal_ray(SHADOW_AT(ox), SHADOW_AT(oy), SHADOW_AT(oz), SHADOW_AT(dx),
                                         SHADOW_AT(dy), SHADOW_AT(dz));
        RayHit hit = traverse(bvh_nodes, bvh_leaves, params.root, &ray, SHADOW_AT(t),
                              SHADOW_INT_AT(excluded), 1);
        if (hit.primitive >= 0) continue;
        int slot = SHADOW_INT_AT(slot);
        RESULT(result_r)[slot] += SHADOW_AT(r);
        RESULT(result_g)[slot] += SHADOW_AT(g);
        RESULT(result_b)[slot] += SHADOW_AT(b);
    }
    statistics[statistic_count * segment + statistic_shadow_rays] += (ulong)(end - base);
}
