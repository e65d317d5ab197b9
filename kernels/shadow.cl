// Shadow: what next event estimation found arrives, unless something is in the way.
#include "device/device.h"

#include "device/path_vertex.h"
#include "device/results.h"
#include "device/state.h"
#include "device/traverse_packet.h"
#include "device/traverse_stream.h"

/// The lanes as far as the closest that they hit of what lets light through; -1: nothing.
FN Path path_to_clear(SceneTables scene, RenderParams params, Path p, Mask lanes) {
    PacketHit hit = traverse_packet(scene.bvh_nodes, scene.bvh_leaves, params.clear_root,
                                    packet_ray(p.origin, p.direction, params.tree_sizes),
                                    params.tree_sizes, p.t, p.excluded, lanes, 0);
    p.t = hit.t, p.b1 = hit.b1, p.b2 = hit.b2;
    p.primitive = sel(hit.primitive == NO_PRIMITIVE, (Int)(-1), hit.primitive);
    return p;
}

#include "device/shadow_clear.h"

/// Which lanes of a packet of shadow rays have something in their way.
FN Mask shadow_packet(global const BvhNode* nodes, global const BvhLine* leaves, StatePlace place,
                      RenderParams params, Mask active) {
    TreeSizes sizes = blocking_sizes(params);
    PacketRay rays = packet_ray(ray_at_origin(place), ray_at_direction(place), sizes);
    PacketHit hit = traverse_packet(nodes, leaves, params.blocking_root, rays, sizes,
                                    ray_at_t(place), ray_at_excluded(place), active, 1);
    return hit.primitive != NO_PRIMITIVE;
}

/// Reads: shadow state. Writes: results (r, g, b, and those of groups, of the rays' own path slots;
/// no other work-item has them), shadow state (blocked, whatever it is).
kernel void shadow(KERNEL_PARAMETERS) {
    CHECK_BOUNDS();
    int segment = get_global_id(0);
    int base = segment * params.segment_stride;
    int end = base + AT(global int, counts, 2 * segment + 1);
    if (HAS(ray_streams))
        traverse_stream(bvh_nodes, bvh_leaves, params.blocking_root, shadow_state,
                        params.state_stride, base, end, 1, blocking_sizes(params));
    for (int at = base; at < end; at += LANES) {
        Mask active = active_lanes(end - at);
        StatePlace place = state_place(shadow_state, params.state_stride, at);
        Mask blocked = HAS(ray_streams)
                           ? load_state_Int(place, shadow_blocked) != 0
                           : shadow_packet(bvh_nodes, bvh_leaves, place, params, active);
        vec3 light = shadow_at_contribution(place);
        if (HAS(clear_shadows) && someLane(active & !blocked)) {
            SceneTables scene = {SCENE_BUFFERS(SCENE_VALUE)};
            Real share = clear_way(scene, params, place, active & !blocked, depth);
            light = scale3(light, share);
            blocked = blocked | !(share > R(0.));
            store_arriving(place, light, blocked);
        }
        uint arrives = maskBits(active & !blocked);
        add_result3(results_of(results, params), result_r, shadow_at_slot(place), light, arrives);
        if (HAS(light_groups))
            add_result3_by_lane(results_of(results, params), shadow_at_group(place),
                                shadow_at_slot(place), light, arrives);
    }
    AT(global ulong, statistics, statistic_count * segment + statistic_shadow_rays) +=
        (ulong)(end - base);
}
