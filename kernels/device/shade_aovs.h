// AOVs of the first vertex.
#ifndef PARHELION_SHADE_AOVS_H
#define PARHELION_SHADE_AOVS_H

#include "device/camera_lanes.h"
#include "device/shade_lobes.h"

/// Into channels of an AOV, from `channel` of its own on; lanes without a hit get nothing.
FN void write_aov1(ShadeWork w, PathVertex v, int kind, int channel, Real value) {
    int offset = w.params->aov_offset[kind];
    if (offset >= 0)
        add_result(w.results, AOV_CHANNEL(offset + channel), v.path.slot, value, maskBits(v.hit));
}
FN void write_aov3(ShadeWork w, PathVertex v, int kind, vec3 value) {
    int offset = w.params->aov_offset[kind];
    if (offset >= 0)
        add_result3(w.results, AOV_CHANNEL(offset), v.path.slot, sel3(v.hit, value, splat3(R(0.))),
                    maskBits(v.hit));
}

/// Which shape the camera's rays have met.
FN void write_shape(ShadeWork w, PathVertex v) {
    Int shape = PRIMITIVE_SHAPE(v.primitive.stored.shape);
    add_result(w.results, SHAPE_CHANNEL(w.params->aov_channels, HAS(filter_splatting)), v.path.slot,
               toReal(shape + 1), maskBits(v.hit));
}

FN void write_aovs(ShadeWork w, PathVertex v, Shading shading) {
    vec3 albedo = material_reflectance(shading.material);
    if (HAS(blends)) albedo = all_lobes_reflectance(w, shading);
    SurfaceInteraction s = v.surface;
    Mask bad = nought3(albedo) + nought3(s.ng) != (s.uv.x + s.uv.y) * R(0.);
    mark_bad(w.results, v.path.slot, v.hit & bad, fault_aov, w.depth);
    write_aov3(w, v, aov_albedo, albedo);
    write_aov3(w, v, aov_sh_normal, s.ns);
    write_aov3(w, v, aov_geo_normal, s.ng);
    write_aov3(w, v, aov_position, s.p);
    write_aov1(w, v, aov_position, 3, R(1.));
    write_aov1(w, v, aov_uv, 0, s.uv.x);
    write_aov1(w, v, aov_uv, 1, s.uv.y);
    Camera camera = camera_lanes(w.params->camera);
    write_aov1(w, v, aov_depth, 0, camera_distance(camera, v.path.origin, v.path.t));
    Int shape = PRIMITIVE_SHAPE(v.primitive.stored.shape),
        first = shape_of(w.scene, v.primitive).first_primitive;
    write_aov1(w, v, aov_shape_index, 0, toReal(shape + 1));
    write_aov1(w, v, aov_prim_index, 0, toReal(v.path.primitive - first));
}

#endif
