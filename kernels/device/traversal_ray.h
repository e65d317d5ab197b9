// Rays made ready for walking the tree: a packet of them, and one taken out of it.

typedef struct {
    vec3 origin, direction;
    RaySlab x, y, z;
    Mask z_is_x, z_is_y; // the direction's largest axis; neither: z
    RayShear shear;
} PacketRay;

/// Renames axes so that the direction's largest is z, keeping their order.
FN vec3 rename_axes(PacketRay r, vec3 v) {
    return v3(sel(r.z_is_x, v.y, sel(r.z_is_y, v.z, v.x)),
              sel(r.z_is_x, v.z, sel(r.z_is_y, v.x, v.y)),
              sel(r.z_is_x, v.x, sel(r.z_is_y, v.y, v.z)));
}

FN PacketRay packet_ray(vec3 origin, vec3 direction, TreeSizes sizes) {
    PacketRay r;
    r.origin = origin;
    r.direction = direction;
    vec3 size = abs3(direction);
    Real largest = max_component(size);
    r.x = ray_slab(origin.x, direction.x, largest, sizes);
    r.y = ray_slab(origin.y, direction.y, largest, sizes);
    r.z = ray_slab(origin.z, direction.z, largest, sizes);
    r.z_is_x = (size.x > size.y) & (size.x > size.z);
    r.z_is_y = (size.x <= size.y) & (size.y > size.z);
    vec3 d = rename_axes(r, direction);
    r.shear.origin = rename_axes(r, origin);
    r.shear.shear_x = d.x / d.z;
    r.shear.shear_y = d.y / d.z;
    r.shear.shear_z = 1.f / d.z;
    r.shear.doubt = ray_doubt(r.shear.shear_z, (Real)sizes.extent);
    return r;
}

typedef struct {
    Real t, b1, b2;
    Real rank;
    Int primitive; // NO_PRIMITIVE: nothing
} PacketHit;

/// Takes the hits of one primitive that rank lower; of those of one rank the lower number wins.
FN void packet_closer(PacketHit* hit, Intersection i, int number, Mask hits) {
    Mask closer =
        hits & ((i.rank < hit->rank) | ((i.rank == hit->rank) & ((Int)number < hit->primitive)));
    hit->t = sel(closer, i.t, hit->t);
    hit->rank = sel(closer, i.rank, hit->rank);
    hit->b1 = sel(closer, i.b1, hit->b1);
    hit->b2 = sel(closer, i.b2, hit->b2);
    hit->primitive = sel(closer, (Int)number, hit->primitive);
}

typedef struct {
    float origin[3], direction[3], inverse[3], near_offset[3], far_offset[3];
    int near_row[3]; // rows of BvhNode::bounds met first; met last: near_row ^ 1
    int axis[3];     // x, y, z after renaming
    float shear[3], doubt;
} TraversalRay;

// The values of a packet that a single ray is taken from.
// clang-format off
#define PACKET_WORDS(X)                                                                            \
    X(origin, 0, r.origin.x) X(origin, 1, r.origin.y) X(origin, 2, r.origin.z)                     \
    X(direction, 0, r.direction.x) X(direction, 1, r.direction.y) X(direction, 2, r.direction.z)   \
    X(inverse, 0, r.x.inverse) X(inverse, 1, r.y.inverse) X(inverse, 2, r.z.inverse)               \
    X(near_offset, 0, r.x.near_offset) X(near_offset, 1, r.y.near_offset)                          \
    X(near_offset, 2, r.z.near_offset) X(far_offset, 0, r.x.far_offset)                            \
    X(far_offset, 1, r.y.far_offset) X(far_offset, 2, r.z.far_offset)                              \
    X(shear, 0, r.shear.shear_x) X(shear, 1, r.shear.shear_y) X(shear, 2, r.shear.shear_z)
// clang-format on

typedef struct {
    RealLanes origin[3], direction[3], inverse[3], near_offset[3], far_offset[3], shear[3], doubt;
    IntLanes largest_axis;
} PacketLanes;

FN PacketLanes packet_lanes(PacketRay r) {
    PacketLanes p;
#define STORE_WORD(name, k, value) p.name[k].lanes = value;
    PACKET_WORDS(STORE_WORD)
    p.doubt.lanes = r.shear.doubt;
    p.largest_axis.lanes = sel(r.z_is_x, (Int)0, sel(r.z_is_y, (Int)1, (Int)2));
    return p;
}

FN TraversalRay single_ray(const PacketLanes* p, int lane) {
    TraversalRay r;
#define TAKE_WORD(name, k, value) r.name[k] = p->name[k].at[lane];
    PACKET_WORDS(TAKE_WORD)
    for (int a = 0; a < 3; a++)
        r.near_row[a] = 2 * a + (r.inverse[a] < 0.f);
    r.doubt = p->doubt.at[lane];
    int z = p->largest_axis.at[lane];
    r.axis[0] = z == 2 ? 0 : z + 1;
    r.axis[1] = z == 0 ? 2 : z - 1;
    r.axis[2] = z;
    return r;
}
