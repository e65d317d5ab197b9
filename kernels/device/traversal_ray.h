// Rays made ready for walking the tree: a packet of them, and one taken out of it.

typedef struct {
    vec3 origin, direction;
    vec3 inverse; // of the direction; infinite for an axis the ray is parallel to: see box_overlap
    Mask negative_x, negative_y, negative_z; // the ray meets the high plane of a box first
    Mask z_is_x, z_is_y;                     // the direction's largest axis; neither: z
    RayShear shear;
} PacketRay;

/// Renames axes so that the direction's largest is z, keeping their order.
FN vec3 rename_axes(PacketRay r, vec3 v) {
    return v3(sel(r.z_is_x, v.y, sel(r.z_is_y, v.z, v.x)),
              sel(r.z_is_x, v.z, sel(r.z_is_y, v.x, v.y)),
              sel(r.z_is_x, v.x, sel(r.z_is_y, v.y, v.z)));
}

FN PacketRay packet_ray(vec3 origin, vec3 direction) {
    PacketRay r;
    r.origin = origin;
    r.direction = direction;
    r.inverse = v3(1.f / direction.x, 1.f / direction.y, 1.f / direction.z);
    r.negative_x = r.inverse.x < 0.f;
    r.negative_y = r.inverse.y < 0.f;
    r.negative_z = r.inverse.z < 0.f;
    vec3 size = abs3(direction);
    r.z_is_x = (size.x > size.y) & (size.x > size.z);
    r.z_is_y = (size.x <= size.y) & (size.y > size.z);
    vec3 d = rename_axes(r, direction);
    r.shear.shear_x = d.x / d.z;
    r.shear.shear_y = d.y / d.z;
    r.shear.shear_z = 1.f / d.z;
    return r;
}

typedef struct {
    float origin[3], direction[3], inverse[3];
    int near_row[3], far_row[3]; // rows of BvhNode::bounds met first and last
    int axis[3];                 // x, y, z after renaming
    float shear[3];
} TraversalRay;

// The values of a packet that a single ray is taken from.
// clang-format off
#define PACKET_WORDS(X)                                                                            \
    X(origin, 0, r.origin.x) X(origin, 1, r.origin.y) X(origin, 2, r.origin.z)                     \
    X(direction, 0, r.direction.x) X(direction, 1, r.direction.y) X(direction, 2, r.direction.z)   \
    X(inverse, 0, r.inverse.x) X(inverse, 1, r.inverse.y) X(inverse, 2, r.inverse.z)               \
    X(shear, 0, r.shear.shear_x) X(shear, 1, r.shear.shear_y) X(shear, 2, r.shear.shear_z)
// clang-format on

typedef struct {
    RealLanes origin[3], direction[3], inverse[3], shear[3];
    IntLanes z_is_x, z_is_y;
} PacketLanes;

FN PacketLanes packet_lanes(PacketRay r) {
    PacketLanes p;
#define STORE_WORD(name, k, value) p.name[k].lanes = value;
    PACKET_WORDS(STORE_WORD)
    p.z_is_x.lanes = r.z_is_x;
    p.z_is_y.lanes = r.z_is_y;
    return p;
}

FN TraversalRay single_ray(const PacketLanes* p, int lane) {
    TraversalRay r;
#define TAKE_WORD(name, k, value) r.name[k] = p->name[k].at[lane];
    PACKET_WORDS(TAKE_WORD)
    for (int a = 0; a < 3; a++) {
        int negative = r.inverse[a] < 0.f;
        r.near_row[a] = 2 * a + negative;
        r.far_row[a] = 2 * a + 1 - negative;
    }
    int z = p->z_is_x.at[lane] ? 0 : p->z_is_y.at[lane] ? 1 : 2;
    r.axis[0] = z == 2 ? 0 : z + 1;
    r.axis[1] = z == 0 ? 2 : z - 1;
    r.axis[2] = z;
    return r;
}
