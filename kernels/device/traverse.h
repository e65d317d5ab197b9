// One ray through the wide BVH: LANES children or primitives at a time; closest hit and any hit are
// one body.
//
// Boxes are widened and triangles are watertight, so no hit is lost; of two hits at the same
// distance the lower primitive number wins, so the answer does not depend on the order of the walk.

#include "device/traversal_ray.h"

#define LANE_GROUPS (BVH_WIDTH / LANES)

typedef struct {
    float t, b1, b2;
    int primitive; // -1: nothing
} RayHit;

#define LEAF_ROW(row) LOAD_REAL(leaf->rows[row] + group * LANES)

FN Intersection leaf_triangles(global const BvhLeaf* leaf, int group, const TraversalRay* ray,
                               float t_max) {
    int x = ray->axis[0], y = ray->axis[1], z = ray->axis[2];
    Real ox = (Real)ray->origin[x], oy = (Real)ray->origin[y], oz = (Real)ray->origin[z];
    RayShear shear;
    shear.shear_x = (Real)ray->shear[0];
    shear.shear_y = (Real)ray->shear[1];
    shear.shear_z = (Real)ray->shear[2];
    vec3 a = v3(LEAF_ROW(x) - ox, LEAF_ROW(y) - oy, LEAF_ROW(z) - oz);
    vec3 b = v3(LEAF_ROW(3 + x) - ox, LEAF_ROW(3 + y) - oy, LEAF_ROW(3 + z) - oz);
    vec3 c = v3(LEAF_ROW(6 + x) - ox, LEAF_ROW(6 + y) - oy, LEAF_ROW(6 + z) - oz);
    return intersect_triangle(a, b, c, shear, (Real)t_max);
}

FN vec3 splat_ray(const float* v) { return v3((Real)v[0], (Real)v[1], (Real)v[2]); }

FN Intersection leaf_spheres(global const BvhLeaf* leaf, int group, const TraversalRay* ray,
                             float t_max) {
    vec3 centre = v3(LEAF_ROW(0), LEAF_ROW(1), LEAF_ROW(2));
    return intersect_sphere(sub3(splat_ray(ray->origin), centre), splat_ray(ray->direction),
                            LEAF_ROW(3), (Real)t_max);
}

FN Intersection leaf_disks(global const BvhLeaf* leaf, int group, const TraversalRay* ray,
                           float t_max) {
    vec3 centre = v3(LEAF_ROW(0), LEAF_ROW(1), LEAF_ROW(2));
    vec3 edge_u = v3(LEAF_ROW(3), LEAF_ROW(4), LEAF_ROW(5)),
         edge_v = v3(LEAF_ROW(6), LEAF_ROW(7), LEAF_ROW(8));
    return intersect_disk(sub3(centre, splat_ray(ray->origin)), splat_ray(ray->direction), edge_u,
                          edge_v, (Real)t_max);
}

FN Intersection leaf_group(global const BvhLeaf* leaf, int kind, int group, const TraversalRay* ray,
                           float t_max) {
    if (HAS(shape_sphere) && kind == geometry_sphere) return leaf_spheres(leaf, group, ray, t_max);
    if (HAS(shape_disk) && kind == geometry_disk) return leaf_disks(leaf, group, ray, t_max);
    return leaf_triangles(leaf, group, ray, t_max);
}

#define LANE_DECLARE(name, v)                                                                      \
    RealLanes name##_lanes;                                                                        \
    name##_lanes.lanes = v;                                                                        \
    const float* name = name##_lanes.at

/// Takes the hits of one leaf into `hit`; returns whether there was one.
FN int leaf_intersect(global const BvhLeaf* leaf, int kind, const TraversalRay* ray, int excluded,
                      int any_hit, RayHit* hit) {
    int found = 0;
    for (int group = 0; group < LANE_GROUPS; group++) {
        Intersection i = leaf_group(leaf, kind, group, ray, hit->t);
        Int primitive = LOAD_INT(leaf->primitive + group * LANES);
        uint bits = maskBits(i.hit & (primitive >= 0) & (primitive != excluded));
        if (!bits) continue;
        found = 1;
        if (any_hit) break;
        LANE_DECLARE(t, i.t);
        LANE_DECLARE(b1, i.b1);
        LANE_DECLARE(b2, i.b2);
        global const int* number = leaf->primitive + group * LANES;
        while (bits) {
            int k = lowest_bit(bits);
            bits &= bits - 1;
            if (t[k] < hit->t ||
                (t[k] == hit->t && (hit->primitive < 0 || number[k] < hit->primitive))) {
                hit->t = t[k];
                hit->b1 = b1[k];
                hit->b2 = b2[k];
                hit->primitive = number[k];
            }
        }
    }
    return found;
}

FN Mask node_overlap(global const BvhNode* node, int group, const TraversalRay* ray, float t_max,
                     Real* entry) {
#define BOX_ROW(row, a)                                                                            \
    ((LOAD_REAL(node->bounds[row] + group * LANES) - (Real)ray->origin[a]) * (Real)ray->inverse[a])
    Real nx = BOX_ROW(ray->near_row[0], 0), fx = BOX_ROW(ray->far_row[0], 0);
    Real ny = BOX_ROW(ray->near_row[1], 1), fy = BOX_ROW(ray->far_row[1], 1);
    Real nz = BOX_ROW(ray->near_row[2], 2), fz = BOX_ROW(ray->far_row[2], 2);
    *entry = maxR(maxR(nx, ny), nz);
    return box_overlap(nx, ny, nz, fx, fy, fz, (Real)t_max);
}

/// Walks the tree from `root` (a child code as in BvhNode); hits beyond t_max do not count. With
/// any_hit the first hit found ends the walk and only `primitive` (0 or -1) is meaningful.
FN RayHit traverse(global const BvhNode* nodes, global const BvhLeaf* leaves, int root,
                   const TraversalRay* ray, float t_max, int excluded, int any_hit) {
    RayHit hit;
    hit.t = t_max, hit.b1 = 0.f, hit.b2 = 0.f, hit.primitive = -1;
    int stack[BVH_STACK];
    float stack_entry[BVH_STACK];
    int top = 0, current = root;
    for (;;) {
        int next = 0, have_next = 0;
        if (current >= 0) {
            global const BvhNode* node = nodes + current;
            float next_entry = 0.f;
            for (int group = 0; group < LANE_GROUPS; group++) {
                Real entry;
                uint bits = maskBits(node_overlap(node, group, ray, hit.t, &entry));
                global const int* child = node->child + group * LANES;
                LANE_DECLARE(near, entry);
                // The nearest child is next; the others wait in no particular order.
                while (bits) {
                    int k = lowest_bit(bits);
                    bits &= bits - 1;
                    int c = child[k];
                    float e = near[k];
                    if (!have_next) {
                        next = c, next_entry = e, have_next = 1;
                    } else {
                        int nearer = !any_hit && e < next_entry;
                        stack[top] = nearer ? next : c;
                        stack_entry[top] = nearer ? next_entry : e;
                        top++;
                        next = nearer ? c : next;
                        next_entry = nearer ? e : next_entry;
                    }
                }
            }
        } else {
            int code = ~current;
            int found =
                leaf_intersect(leaves + (code >> 2), code & 3, ray, excluded, any_hit, &hit);
            if (any_hit && found) {
                hit.primitive = 0;
                return hit;
            }
        }
        if (have_next) {
            current = next;
            continue;
        }
        do {
            if (top == 0) return hit;
            top--;
        } while (stack_entry[top] > hit.t * (float)BOX_WIDENING);
        current = stack[top];
    }
}
