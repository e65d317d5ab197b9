// From a position on the film (and on the lens) to a ray.

typedef struct {
    vec3 origin;
    vec3 direction; // unit
    Real t_max;
} CameraRay;

/// Of a far camera: from where the axis meets the plane on which rays begin to where the ray of a
/// film position does. Made of differences, so that the camera's distance loses nothing.
FN vec3 from_axis(Camera c, vec2 film) {
    Real x = (film.x - c.axis_x) * c.start, y = (film.y - c.axis_y) * c.start;
    return add3(scale3(v3(c.ux, c.uy, c.uz), x), scale3(v3(c.vx, c.vy, c.vz), y));
}

/// From the near plane to the point at t of a camera ray from `origin`.
FN Real camera_distance(Camera c, vec3 origin, Real t) {
    if (!HAS(far_camera)) return t;
    Real before = length3(sub3(origin, v3(c.fx, c.fy, c.fz))) * c.clear_share;
    if (HAS(orthographic)) before = sel(c.parallel != R(0.), c.start, before);
    return t + before;
}

/// Of an orthographic camera: parallel to all others.
FN CameraRay parallel_ray(Camera c, vec2 film) {
    vec3 at = add3(v3(c.ox, c.oy, c.oz), add3(scale3(v3(c.ux, c.uy, c.uz), film.x),
                                              scale3(v3(c.vx, c.vy, c.vz), film.y)));
    CameraRay ray;
    ray.direction = v3(c.dx, c.dy, c.dz);
    ray.origin = add3(at, scale3(ray.direction, c.near_clip));
    ray.t_max = c.far_clip - c.near_clip;
    return ray;
}

/// film: pixels from the top left corner of the full film; lens: point of the unit disk.
/// The ray starts on the near plane and ends on the far plane.
FN CameraRay camera_ray(Camera c, vec2 film, vec2 lens) {
    vec3 origin = v3(c.ox, c.oy, c.oz);
    if (HAS(far_camera)) origin = add3(origin, from_axis(c, film));
    vec3 d = add3(v3(c.dx, c.dy, c.dz),
                  add3(scale3(v3(c.ux, c.uy, c.uz), film.x), scale3(v3(c.vx, c.vy, c.vz), film.y)));
    if (HAS(thin_lens)) {
        vec3 on_lens =
            add3(scale3(v3(c.lx, c.ly, c.lz), lens.x), scale3(v3(c.mx, c.my, c.mz), lens.y));
        // The lens lies across the optical axis, so the bent direction keeps its unit length along
        // it.
        d = sub3(d, scale3(on_lens, R(1.) / c.focus_distance));
        if (HAS(far_camera)) on_lens = scale3(on_lens, R(1.) - c.lens_shift);
        origin = add3(origin, on_lens);
    }
    Real length = length3(d);
    CameraRay ray;
    ray.origin = add3(origin, scale3(d, c.near_clip));
    ray.direction = scale3(d, R(1.) / length);
    ray.t_max = (c.far_clip - c.near_clip) * length;
    if (HAS(orthographic)) {
        Mask mine = c.parallel != R(0.);
        CameraRay parallel = parallel_ray(c, film);
        ray.origin = sel3(mine, parallel.origin, ray.origin);
        ray.direction = sel3(mine, parallel.direction, ray.direction);
        ray.t_max = sel(mine, parallel.t_max, ray.t_max);
    }
    return ray;
}
