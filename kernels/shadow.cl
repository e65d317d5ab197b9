// Shadow: what next event estimation found arrives, unless something is in the way.
#include "device/device.h"
#include "device/lanes_memory.h"
#include "device/path_state.h"
#include "device/traverse_packet.h"

/// Reads: shadow state. Writes: results (r, g, b of the rays' own path slots; no other work-item
/// has them).
kernel void shadow(KERNEL_PARAMETERS) {
    int segment = get_global_id(0);
    int base = segment * params.segment_stride;
    int end = base + counts[2 * segment + 1];
    for (int at = base; at < end; at += LANES) {
        PacketRay rays =
            packet_ray(v3(SHADOW_LOAD_REAL(ox), SHADOW_LOAD_REAL(oy), SHADOW_LOAD_REAL(oz)),
                       v3(SHADOW_LOAD_REAL(dx), SHADOW_LOAD_REAL(dy), SHADOW_LOAD_REAL(dz)));
        Mask active = active_lanes(end - at);
        PacketHit hit = traverse_packet(bvh_nodes, bvh_leaves, params.root, rays,
                                        SHADOW_LOAD_REAL(t), SHADOW_LOAD_INT(excluded), active, 1);
        vec3 light = v3(SHADOW_LOAD_REAL(r), SHADOW_LOAD_REAL(g), SHADOW_LOAD_REAL(b));
        add_result3(results, params.path_capacity, result_r, SHADOW_LOAD_INT(slot), light,
                    maskBits(active & (hit.primitive < 0)));
    }
    statistics[statistic_count * segment + statistic_shadow_rays] += (ulong)(end - base);
}
