// From a position on the film (and on the lens) to a ray.

typedef struct {
    vec3 origin;
    vec3 direction; // unit
    Real t_max;
} CameraRay;

/// film: pixels from the top left corner of the full film; lens: point of the unit disk.
/// The ray starts on the near plane and ends on the far plane.
FN CameraRay camera_ray(Camera c, vec2 film, vec2 lens) {
    vec3 origin = v3(c.ox, c.oy, c.oz);
    vec3 d = add3(v3(c.dx, c.dy, c.dz),
                  add3(scale3(v3(c.ux, c.uy, c.uz), film.x), scale3(v3(c.vx, c.vy, c.vz), film.y)));
    if (HAS(thin_lens)) {
        vec3 on_lens =
            add3(scale3(v3(c.lx, c.ly, c.lz), lens.x), scale3(v3(c.mx, c.my, c.mz), lens.y));
        // The lens lies across the optical axis, so the bent direction keeps its unit length along
        // it.
        d = sub3(d, scale3(on_lens, R(1.) / c.focus_distance));
        origin = add3(origin, on_lens);
    }
    Real length = length3(d);
    CameraRay ray;
    ray.origin = add3(origin, scale3(d, c.near_clip));
    ray.direction = scale3(d, R(1.) / length);
    ray.t_max = (c.far_clip - c.near_clip) * length;
    return ray;
}
