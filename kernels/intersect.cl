// Intersect: the closest hit of every live path.
#include "device/device.h"

#include "device/state.h"
#include "device/traverse_packet.h"
#include "device/traverse_stream.h"

/// Rays that go the same way, LANES at a time.
FN void intersect_packets(global const BvhNode* nodes, global const BvhLine* leaves, int root,
                          global float* path_state, RenderParams params, int begin, int end) {
    for (int at = begin; at < end; at += LANES) {
        StatePlace place = state_place(path_state, params.state_stride, at);
        PacketRay rays =
            packet_ray(ray_at_origin(place), ray_at_direction(place), params.tree_sizes);
        PacketHit hit =
            traverse_packet(nodes, leaves, root, rays, params.tree_sizes, ray_at_t(place),
                            ray_at_excluded(place), active_lanes(end - at), 0);
        store_hit(place, hit.t, hit.b1, hit.b2,
                  sel(hit.primitive == NO_PRIMITIVE, (Int)(-1), hit.primitive));
    }
}

/// Reads: path state (ray, t as its end, excluded). Writes: path state (t, b1, b2, primitive).
kernel void intersect(KERNEL_PARAMETERS) {
    CHECK_BOUNDS();
    int segment = get_global_id(0);
    int base = segment * params.segment_stride;
    int end = base + AT(global int, counts, 2 * segment);
    int root = depth == 0 ? params.camera_root : params.root;
    if (HAS(ray_streams) && depth > 0)
        traverse_stream(bvh_nodes, bvh_leaves, root, path_state, params.state_stride, base, end, 0,
                        params.tree_sizes);
    else
        intersect_packets(bvh_nodes, bvh_leaves, root, path_state, params, base, end);
    if (depth > 0)
        AT(global ulong, statistics, statistic_count * segment + statistic_bounce_rays) +=
            (ulong)(end - base);
}
