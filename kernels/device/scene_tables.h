// The scene's buffers (SCENE_BUFFERS) as one value, and the primitives in them.
#ifndef PARHELION_SCENE_TABLES_H
#define PARHELION_SCENE_TABLES_H

#include "device/lanes_memory.h"

#define SCENE_MEMBER(type, name) global const type* name;
typedef struct {
    SCENE_BUFFERS(SCENE_MEMBER)
} SceneTables;
/// Of a kernel's parameters.
#define SCENE_VALUE(type, name) name,

/// A primitive and what its corners have, as far as kernels read it; what has none gets some
/// numbers.
typedef struct {
    IndexedPrimitive stored;
    Primitive whole;
    Vertex corners;
} ScenePrimitive;

FN Vertex vertex_attributes(Record a, Record b, Record c) {
    Vertex v;
    if (HAS(vertex_normals)) {
        int at = POINT_NORMAL;
        v.n0x = a.word[at], v.n0y = a.word[at + 1], v.n0z = a.word[at + 2];
        v.n1x = b.word[at], v.n1y = b.word[at + 1], v.n1z = b.word[at + 2];
        v.n2x = c.word[at], v.n2y = c.word[at + 1], v.n2z = c.word[at + 2];
    }
    if (HAS(vertex_uvs)) {
        int at = POINT_UV(HAS(vertex_normals));
        v.u0 = a.word[at], v.v0 = a.word[at + 1];
        v.u1 = b.word[at], v.v1 = b.word[at + 1];
        v.u2 = c.word[at], v.v2 = c.word[at + 1];
    }
    return v;
}

typedef struct {
    Record a, b, c;
} PointRecords;

#define POINT_LENGTH POINT_WORDS(HAS(vertex_normals), HAS(vertex_uvs))

/// Corners of the primitive in each lane, whose record begins with that word.
FN PointRecords load_points(SceneTables scene, IntLanes first) {
    PointRecords p;
#ifdef QUADS
    // Lane by lane: indices are needed one by one, and stay in registers. They are volatile lest
    // compilers make vectors of them, to take apart again.
#define POINT_QUAD(which)                                                                          \
    AT_WORD(global const Quad, scene.points,                                                       \
            (ulong) * (global const volatile uint*)&stored->which + at)
#pragma unroll
    for (int quad = 0; quad < (POINT_LENGTH + 3) / 4; quad++) {
        int at = quad_begin(quad, POINT_LENGTH);
        Quads a, b, c;
#pragma unroll
        for (int k = 0; k < LANES; k++) {
            global const IndexedPrimitiveRecord* stored = WORD_IN_BUFFER(
                global const IndexedPrimitiveRecord, scene.primitives, (ulong)(uint)first.at[k]);
            a.row[k] = POINT_QUAD(a);
            b.row[k] = POINT_QUAD(b);
            c.row[k] = POINT_QUAD(c);
        }
        p.a = with_quads(p.a, at, a);
        p.b = with_quads(p.b, at, b);
        p.c = with_quads(p.c, at, c);
    }
#else
    IntLanes a, b, c;
    for (int k = 0; k < LANES; k++) {
        a.at[k] = AT(global const int, scene.primitives, first.at[k]);
        b.at[k] = AT(global const int, scene.primitives, first.at[k] + 1);
        c.at[k] = AT(global const int, scene.primitives, first.at[k] + 2);
    }
    p.a = load_record(scene.points, a, POINT_LENGTH);
    p.b = load_record(scene.points, b, POINT_LENGTH);
    p.c = load_record(scene.points, c, POINT_LENGTH);
#endif
    return p;
}

FN ScenePrimitive load_scene_primitive(SceneTables scene, Int number) {
    int words = sizeof(IndexedPrimitiveRecord) / sizeof(int);
    PointRecords points = load_points(scene, one_by_one(number * words));
    Record a = points.a, b = points.b, c = points.c;
    ScenePrimitive p;
    p.stored = load_IndexedPrimitive(scene.primitives, number);
    p.whole.ax = a.word[0], p.whole.ay = a.word[1], p.whole.az = a.word[2];
    p.whole.bx = b.word[0], p.whole.by = b.word[1], p.whole.bz = b.word[2];
    p.whole.cx = c.word[0], p.whole.cy = c.word[1], p.whole.cz = c.word[2];
    p.whole.extra = p.stored.extra;
    p.whole.flags = PRIMITIVE_FLAGS(p.stored.shape);
    p.corners = vertex_attributes(a, b, c);
    return p;
}

FN Shape shape_of(SceneTables scene, ScenePrimitive p) {
    return load_Shape(scene.shapes, PRIMITIVE_SHAPE(p.stored.shape));
}

#endif
