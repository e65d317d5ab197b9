// What a packet of paths has reached: the state of each and the surface it is on.
#ifndef PARHELION_PATH_VERTEX_H
#define PARHELION_PATH_VERTEX_H

#include "device/results.h"
#include "device/scene_tables.h"
#include "device/state.h"
#include "device/texture.h"

typedef struct {
    Path path;
    Mask active;  // lanes that hold a path
    Mask hit;     // of those, that have hit something
    Mask bad_hit; // where that is at no numbers: it counts as none
    ScenePrimitive primitive;
    SurfaceInteraction surface;
} PathVertex;

FN SurfaceInteraction surface_at(ScenePrimitive primitive, Path path, Mask hit) {
    Primitive p = primitive.whole;
    SurfaceInteraction s = surface_triangle(p, path.b1, path.b2);
    if (HAS(vertex_normals) || HAS(vertex_uvs)) {
        Mask has_attributes = (p.flags & (PRIMITIVE_NORMALS | PRIMITIVE_UVS)) != 0;
        if (someLane(has_attributes & hit))
            s = surface_vertex_attributes(s, p, primitive.corners, path.b1, path.b2);
    }
    if (HAS(shape_sphere)) {
        Mask mine = primitive_kind(p) == geometry_sphere;
        if (someLane(mine)) {
            vec3 there = add3(path.origin, scale3(path.direction, path.t));
            s = sel_surface(mine, surface_sphere(p, there), s);
        }
    }
    if (HAS(shape_cylinder)) {
        Mask mine = primitive_kind(p) == geometry_cylinder;
        if (someLane(mine)) {
            vec3 there = add3(path.origin, scale3(path.direction, path.t));
            s = sel_surface(mine, surface_cylinder(p, there), s);
        }
    }
    if (HAS(shape_disk)) {
        Mask mine = primitive_kind(p) == geometry_disk;
        if (someLane(mine)) s = sel_surface(mine, surface_disk(p, path.b1, path.b2), s);
    }
    return s;
}

/// Of the active lanes, whose path has come to its primitive; -1: nothing.
FN PathVertex vertex_of(Path path, Mask active, SceneTables scene) {
    PathVertex v;
    v.path = path;
    v.active = active;
    // Lanes behind the last path hold leftovers: they count as misses, and primitive 0 stands in
    // for what they hit.
    v.hit = v.active & (v.path.primitive >= 0);
    v.path.primitive = sel(v.hit, v.path.primitive, (Int)0);
    v.primitive = load_scene_primitive(scene, v.path.primitive);
    v.surface = surface_at(v.primitive, v.path, v.hit);
    v.bad_hit = v.hit & (nought3(v.surface.p) + nought3(v.surface.ns) != v.path.t * R(0.));
    v.hit = v.hit & !v.bad_hit;
    return v;
}

/// The vertices that `left` paths are at, or a packet's first of them.
FN PathVertex load_vertex(StatePlace place, int left, SceneTables scene) {
    return vertex_of(load_path(place), active_lanes(left), scene);
}

/// Where textures are looked up.
FN TexturePlace texture_place(PathVertex v) {
    TexturePlace place;
    place.uv = v.surface.uv;
    place.primitive = v.path.primitive;
    place.shape = PRIMITIVE_SHAPE(v.primitive.stored.shape);
    place.b1 = v.path.b1;
    place.b2 = v.path.b2;
    return place;
}

/// What a ray that goes on from there may not hit: flat primitives it cannot hit again.
FN Int excluded_behind(PathVertex v) {
    Mask round = primitive_kind(v.primitive.whole) == geometry_sphere;
    if (HAS(shape_cylinder))
        round = round | (primitive_kind(v.primitive.whole) == geometry_cylinder);
    return sel(round, (Int)(-1), v.path.primitive);
}

#endif
