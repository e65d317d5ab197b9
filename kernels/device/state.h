// Paths and shadow rays, and how a packet of them is loaded and stored: made from their lists
// (buffers.h). Lists of states are packed: those that go on lie one behind the other.
#ifndef PARHELION_STATE_H
#define PARHELION_STATE_H

#include "device/lanes_memory.h"

#define STATE_MEMBER(type, name, needed) type name;
typedef struct {
    PATH_FIELDS(STATE_MEMBER)
} Path;
typedef struct {
    SHADOW_FIELDS(STATE_MEMBER)
} ShadowRay;

/// An entry of a list of states and those behind it: a word each, and `stride` further the next
/// word of the same.
typedef struct {
    global Scalar* first;
    long stride;
} StatePlace;

FN StatePlace state_place(global Scalar* states, long stride, int entry) {
    StatePlace s;
    s.first = states + entry;
    s.stride = stride;
    return s;
}

FN global Scalar* state_word(StatePlace s, int word) { return s.first + word * s.stride; }

FN Real load_state_Real(StatePlace s, int word) { return LOAD_REAL(state_word(s, word)); }
FN Int load_state_Int(StatePlace s, int word) {
    return LOAD_INT((global const int*)state_word(s, word));
}
FN vec3 load_state_vec3(StatePlace s, int word) {
    return v3(load_state_Real(s, word), load_state_Real(s, word + 1), load_state_Real(s, word + 2));
}

FN void store_state_Real(StatePlace s, int word, Real v) { STORE_REAL(state_word(s, word), v); }
FN void store_state_Int(StatePlace s, int word, Int v) {
    STORE_INT((global int*)state_word(s, word), v);
}

FN void pack_state_Real(StatePlace s, int word, Real v, uint bits) {
    store_packed(state_word(s, word), v, bits);
}
FN void pack_state_Int(StatePlace s, int word, Int v, uint bits) {
    store_packed_int((global int*)state_word(s, word), v, bits);
}
FN void pack_state_vec3(StatePlace s, int word, vec3 v, uint bits) {
    pack_state_Real(s, word, v.x, bits);
    pack_state_Real(s, word + 1, v.y, bits);
    pack_state_Real(s, word + 2, v.z, bits);
}

// A field by itself, e.g. ray_at_origin(place), of a path or of a shadow ray: a walk through the
// tree should not have to keep what it does not need.
#define RAY_GETTER(type, name, needed)                                                             \
    FN type ray_at_##name(StatePlace s) { return load_state_##type(s, ray_##name); }
#define SHADOW_GETTER(type, name, needed)                                                          \
    FN type shadow_at_##name(StatePlace s) { return load_state_##type(s, shadow_##name); }
RAY_FIELDS(RAY_GETTER)
BROUGHT_FIELDS(SHADOW_GETTER)

// What nobody needs is neither stored nor loaded: it has no value.
#define LOAD_PATH(type, name, needed)                                                              \
    if (needed) p.name = load_state_##type(s, path_##name);
#define PACK_PATH(type, name, needed)                                                              \
    if (needed) pack_state_##type(s, path_##name, p.name, bits);
#define PACK_SHADOW(type, name, needed)                                                            \
    if (needed) pack_state_##type(s, shadow_##name, r.name, bits);

FN Path load_path(StatePlace s) {
    Path p;
    PATH_FIELDS(LOAD_PATH)
    return p;
}

/// Stores the lanes whose bits are set, without a hit; how many they are.
FN int pack_path(StatePlace s, Path p, uint bits) {
    RAY_FIELDS(PACK_PATH)
    CARRIED_FIELDS(PACK_PATH)
    return popcount(bits);
}

/// Likewise.
FN int pack_shadow_ray(StatePlace s, ShadowRay r, uint bits) {
    RAY_FIELDS(PACK_SHADOW)
    BROUGHT_FIELDS(PACK_SHADOW)
    return popcount(bits);
}

/// What shadow rays bring after all, and whether anything was in their way.
FN void store_arriving(StatePlace s, vec3 contribution, Mask blocked) {
    store_state_Real(s, shadow_contribution, contribution.x);
    store_state_Real(s, shadow_contribution_y, contribution.y);
    store_state_Real(s, shadow_contribution_z, contribution.z);
    if (HAS(ray_streams)) store_state_Int(s, shadow_blocked, sel(blocked, (Int)1, (Int)0));
}

FN void store_hit(StatePlace s, Real t, Real b1, Real b2, Int primitive) {
    store_state_Real(s, path_t, t);
    store_state_Real(s, path_b1, b1);
    store_state_Real(s, path_b2, b2);
    store_state_Int(s, path_primitive, primitive);
}

/// Lanes of a packet that hold an entry: `left` entries from its first lane on.
FN Mask active_lanes(int left) { return LANE_INDEX < (Int)left; }

#endif
