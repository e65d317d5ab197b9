// Reading and writing a packet of paths or shadow rays, and the paths' results.
#ifndef PARHELION_PATH_STATE_H
#define PARHELION_PATH_STATE_H

#define PATH_LOAD_REAL(name) LOAD_REAL(path_state + (long)path_##name * params.state_stride + at)
#define PATH_LOAD_INT(name)                                                                        \
    LOAD_INT((global const int*)(path_state + (long)path_##name * params.state_stride + at))
#define PATH_PACK_REAL(name, v)                                                                    \
    store_packed(path_state + (long)path_##name * params.state_stride + to, v, bits)
#define PATH_PACK_INT(name, v)                                                                     \
    store_packed_int((global int*)(path_state + (long)path_##name * params.state_stride + to), v,  \
                     bits)
#define SHADOW_PACK_REAL(name, v)                                                                  \
    store_packed(shadow_state + (long)shadow_##name * params.state_stride + to, v, bits)
#define SHADOW_PACK_INT(name, v)                                                                   \
    store_packed_int((global int*)(shadow_state + (long)shadow_##name * params.state_stride + to), \
                     v, bits)

#define PATH_STORE_REAL(name, v)                                                                   \
    STORE_REAL(path_state + (long)path_##name * params.state_stride + at, v)
#define PATH_STORE_INT(name, v)                                                                    \
    STORE_INT((global int*)(path_state + (long)path_##name * params.state_stride + at), v)
#define SHADOW_LOAD_REAL(name)                                                                     \
    LOAD_REAL(shadow_state + (long)shadow_##name * params.state_stride + at)
#define SHADOW_LOAD_INT(name)                                                                      \
    LOAD_INT((global const int*)(shadow_state + (long)shadow_##name * params.state_stride + at))

#define RESULT(channel) (results + (long)(channel)*params.result_stride)

/// Adds v to three neighbouring result channels of the lanes' slots.
FN void add_result3(global Scalar* results, long stride, int channel, Int slot, vec3 v, uint bits) {
    scatter_add3(results + channel * stride, stride, slot, v, bits);
}

/// Lanes of a packet that hold an entry: `left` entries from its first lane on.
FN Mask active_lanes(int left) { return LANE_INDEX < (Int)left; }

#endif
