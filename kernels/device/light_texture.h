// What textures tell of the radiance of area lights, where they are met and where they are sampled,
// and of what lights without size shine through.
#ifndef PARHELION_LIGHT_TEXTURE_H
#define PARHELION_LIGHT_TEXTURE_H

#include "device/path_vertex.h"

/// Coordinates of q along the edges of flat primitives: barycentrics of a triangle.
FN vec2 along_edges(Primitive p, vec3 q) {
    Mask disk = primitive_kind(p) == geometry_disk;
    vec3 a = primitive_a(p), b = primitive_b(p), c = primitive_c(p);
    vec3 u = sel3(disk, b, sub3(b, a)), v = sel3(disk, c, sub3(c, a)), to = sub3(q, a);
    vec3 n = cross3(u, v);
    Real n_squared = dot3(n, n);
    Real scale = R(1.) / sel(n_squared > R(0.), n_squared, R(1.));
    return v2(dot3(cross3(to, v), n) * scale, dot3(cross3(u, to), n) * scale);
}

/// The point q of primitive `number`, as if path p had come there.
FN PathVertex vertex_at(SceneTables scene, Path p, Int number, vec3 q, Mask lanes) {
    p.origin = q, p.direction = splat3(R(0.)), p.t = R(0.);
    p.primitive = sel(lanes, number, (Int)0);
    vec2 at = along_edges(load_scene_primitive(scene, p.primitive).whole, q);
    p.b1 = at.x, p.b2 = at.y;
    return vertex_of(p, lanes, scene);
}

FN Int light_word(SceneTables scene, Int row, int word) {
    return gather_int(scene.light_textures, row * LIGHT_TEXTURE_WORDS + word);
}

/// What the radiance of the light in row `row` is multiplied by there.
FN vec3 light_color(SceneTables scene, Int row, TexturePlace place, Mask lanes) {
    return textured_color(scene, light_word(scene, row, 0), place, lanes, splat3(R(1.)));
}

/// The same at its point q, which it has been sampled at: two triangles may be one light.
FN vec3 sampled_light_color(SceneTables scene, Path path, Int row, vec3 q, Mask lanes) {
    lanes = lanes & (light_word(scene, row, 0) >= 0);
    if (HAS(projected_textures)) lanes = lanes & (light_word(scene, row, 2) > 0);
    if (!someLane(lanes)) return splat3(R(1.));
    Int number = light_word(scene, row, 1);
    PathVertex v = vertex_at(scene, path, number, q, lanes);
    Mask inside = (v.path.b1 >= R(0.)) & (v.path.b2 >= R(0.)) & (v.path.b1 + v.path.b2 <= R(1.));
    Mask other = lanes & (light_word(scene, row, 2) > 1) & !inside;
    if (someLane(other)) v = vertex_at(scene, path, sel(other, number + 1, number), q, lanes);
    return light_color(scene, row, texture_place(v), lanes);
}

/// What the light in row `row`, which has no size, shines through towards a sample of it.
FN vec3 projected_color(SceneTables scene, Light light, Int row, EmitterSample s, Mask lanes) {
    lanes = lanes & (light_word(scene, row, 0) >= 0) & (light_word(scene, row, 2) == 0) &
            (max_component(s.weight) > R(0.)); // elsewhere it may be no place at all
    if (!someLane(lanes)) return splat3(R(1.));
    Int frame = sel(lanes, light_word(scene, row, 1), (Int)0);
    global const float* words = (global const float*)scene.light_textures;
    TexturePlace place;
    place.uv = frame_place(light_b(light), load_color(scene.light_textures, frame),
                           gather(words + 3, frame), neg3(s.wi));
    place.primitive = place.shape = (Int)0;
    place.b1 = place.b2 = R(0.);
    return textured_color(scene, light_word(scene, row, 0), place, lanes, splat3(R(1.)));
}

#endif
