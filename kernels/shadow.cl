// Shadow: what next event estimation found arrives, unless something is in the way.
#include "device/device.h"
#include "device/lanes_memory.h"
#include "device/path_state.h"
#include "device/traverse_packet.h"
#include "device/traverse_stream.h"

/// Which lanes of a packet of shadow rays have something in their way.
FN Mask shadow_packet(global const BvhNode* nodes, global const BvhLine* leaves,
                      global const float* shadow_state, RenderParams params, int at, Mask active) {
    PacketRay rays =
        packet_ray(v3(SHADOW_LOAD_REAL(ox), SHADOW_LOAD_REAL(oy), SHADOW_LOAD_REAL(oz)),
                   v3(SHADOW_LOAD_REAL(dx), SHADOW_LOAD_REAL(dy), SHADOW_LOAD_REAL(dz)),
                   blocking_sizes(params));
    PacketHit hit = traverse_packet(nodes, leaves, params.root, rays, blocking_sizes(params),
                                    SHADOW_LOAD_REAL(t), SHADOW_LOAD_INT(excluded), active, 1);
    return hit.primitive != NO_PRIMITIVE;
}

/// Reads: shadow state. Writes: results (r, g, b of the rays' own path slots; no other work-item
/// has them), shadow state (blocked).
kernel void shadow(KERNEL_PARAMETERS) {
    CHECK_BOUNDS();
    int segment = get_global_id(0);
    int base = segment * params.segment_stride;
    int end = base + AT(global int, counts, 2 * segment + 1);
    if (HAS(ray_streams))
        traverse_stream(bvh_nodes, bvh_leaves, params.root, shadow_state, params.state_stride, base,
                        end, 1, blocking_sizes(params));
    for (int at = base; at < end; at += LANES) {
        Mask active = active_lanes(end - at);
        Mask blocked = HAS(ray_streams)
                           ? SHADOW_LOAD_INT(blocked) != 0
                           : shadow_packet(bvh_nodes, bvh_leaves, shadow_state, params, at, active);
        vec3 light = v3(SHADOW_LOAD_REAL(r), SHADOW_LOAD_REAL(g), SHADOW_LOAD_REAL(b));
        add_result3(results, params.result_stride, result_r, SHADOW_LOAD_INT(slot), light,
                    maskBits(active & !blocked));
    }
    AT(global ulong, statistics, statistic_count * segment + statistic_shadow_rays) +=
        (ulong)(end - base);
}
