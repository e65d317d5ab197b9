// A sky whose radiance an image tells, in the sky's own frame: y up, columns of texels around it,
// from -z over x on; the first row of texels lies at +y, the last at -y. a, b, c: the frame's axes
// in world space (orthonormal), rgb: what the image is multiplied by.
//
// Between four texels lies a cell, in which radiance is bilinear in azimuth and polar angle. One is
// chosen with its probability (device/environment.h), and in it a direction with a density
// proportional to the brightness, taken to be bilinear in azimuth and in the cosine of the polar
// angle: uniform where the brightness is. Polar angles count from the nearer pole, so that nothing
// cancels near either.

/// Rows of cells by their distance from the nearer pole, of `rows` from one to the other.
typedef struct {
    Real first;   // angle of its border nearer to the pole, turns
    Real reach;   // half its height, turns
    Real cosines; // difference of its borders' cosines
} PolarRow;

FN PolarRow polar_row(Int from_pole, Real rows) {
    PolarRow r;
    r.reach = R(.25) / rows;
    r.first = toReal(from_pole) * (r.reach + r.reach);
    r.cosines = 2.f * sincos_turns(r.first + r.reach).sine * sincos_turns(r.reach).sine;
    return r;
}

/// Which cell, and where in it. `along`: from its first column of texels to the next; `down`: from
/// the border nearer to the pole to the other, in angle; `by_cosine`: the same in cosine.
typedef struct {
    Int column, row;
    Mask south; // the nearer pole is -y
    Real along, down, by_cosine;
} SkyPlace;

/// Row of cells nearer to -y than to +y, of `rows`; and counted from there.
FN Mask sky_south(Int row, Int rows) { return row + row >= rows; }
FN Int row_from_pole(Int row, Int rows) { return sel(sky_south(row, rows), rows - 1 - row, row); }

/// Where a direction of the sky's frame meets the image.
FN SkyPlace sky_place(vec3 w, Int width, Int rows) {
    SkyPlace s;
    Real around = atan2R(w.x, -w.z) * R(INV_TWO_PI);
    Real place = (around - floorR(around)) * toReal(width) - R(.5);
    Real before = floorR(place);
    s.along = place - before;
    s.column = sel(before < R(0.), width - 1, toInt(before));
    s.column = sel(s.column >= width, width - 1, s.column); // 1 - 1e-8 turns round up
    Real polar = atan2R(sqrtR(w.x * w.x + w.z * w.z), absR(w.y));
    Real fall = polar * R(INV_PI) * toReal(rows);
    Real above = floorR(fall);
    s.down = fall - above;
    s.south = w.y < R(0.);
    Int from_pole = toInt(above);
    s.row = sel(s.south, rows - 1 - from_pole, from_pole);
    // All of the row about the equator counts from +y, and what rounding takes across it as that
    // row does.
    Mask south = sky_south(s.row, rows);
    s.down = sel((s.south & !south) | (south & !s.south), R(1.) - s.down, s.down);
    s.south = south;
    PolarRow r = polar_row(row_from_pole(s.row, rows), toReal(rows));
    Real halved = s.down * r.reach;
    s.by_cosine = 2.f * sincos_turns(r.first + halved).sine * sincos_turns(halved).sine / r.cosines;
    return s;
}

/// Of a cell: the texels at the border nearer to the pole (near) and at the other, at its first
/// column and the next; with the probability with which it is chosen.
typedef struct {
    vec3 near_first, near_next, far_first, far_next;
    Real probability;
} SkyCell;

FN vec3 sky_bilinear(SkyCell c, Real along, Real down) {
    vec3 near = add3(c.near_first, scale3(sub3(c.near_next, c.near_first), along));
    vec3 far = add3(c.far_first, scale3(sub3(c.far_next, c.far_first), along));
    return add3(near, scale3(sub3(far, near), down));
}

/// Density in solid angle of choosing that place of the cell.
FN Real sky_density(SkyCell c, SkyPlace s, Int width, Int rows) {
    Real mean = R(.25) * mean_component(
                             add3(add3(c.near_first, c.near_next), add3(c.far_first, c.far_next)));
    Real there = mean_component(sky_bilinear(c, s.along, s.by_cosine));
    Real angle = polar_row(row_from_pole(s.row, rows), toReal(rows)).cosines * R(TWO_PI);
    Mask lit = mean > R(0.);
    return sel(lit, c.probability * toReal(width) * there / (sel(lit, mean, R(1.)) * angle), R(0.));
}

/// Of a density on [0, 1] that is linear from a to b, where the share u lies before.
FN Real linear_sample(Real a, Real b, Real u) {
    Real largest = maxR(a, b);
    Mask some = largest > R(0.);
    Real scale = R(1.) / sel(some, largest, R(1.));
    Real first = a * scale, last = b * scale;
    Real reach = first + sqrtR(first * first * (R(1.) - u) + last * last * u);
    return sel(some, u * (first + last) / sel(reach > R(0.), reach, R(1.)), u);
}

/// A place in the cell by u.x (along) and u.y (down); its direction in the sky's frame in `w`.
typedef struct {
    SkyPlace place;
    vec3 w;
} SkySample;

FN SkySample sky_sample(SkyCell c, Int column, Int row, Int width, Int rows, vec2 u) {
    SkySample s;
    Int from_pole = row_from_pole(row, rows);
    PolarRow r = polar_row(from_pole, toReal(rows));
    Real near_first = mean_component(c.near_first), near_next = mean_component(c.near_next);
    Real far_first = mean_component(c.far_first), far_next = mean_component(c.far_next);
    Real down = linear_sample(near_first + near_next, far_first + far_next, u.y);
    s.place.column = column;
    s.place.row = row;
    s.place.south = sky_south(row, rows);
    s.place.by_cosine = down;
    s.place.along = linear_sample(near_first + down * (far_first - near_first),
                                  near_next + down * (far_next - near_next), u.x);
    // From 1 - cosine of the polar angle to sines and cosines of half of it.
    SinCos half_first = sincos_turns(R(.5) * r.first);
    Real fallen = down * r.cosines, lost = 2.f * half_first.sine * half_first.sine + fallen;
    Real sine = sqrtR(R(.5) * lost), cosine = sqrt_nonnegative(R(1.) - R(.5) * lost);
    Real sum = sine * half_first.cosine + cosine * half_first.sine; // sine of (angle + first) / 2
    Real halved = fallen / sel(sum > R(0.), 2.f * sum, R(1.));      // of (angle - first) / 2
    Real turned = atan2R(halved, sqrt_nonnegative(R(1.) - halved * halved)) * R(INV_TWO_PI);
    s.place.down = turned / r.reach;
    Real around = (toReal(column) + R(.5) + s.place.along) / toReal(width);
    SinCos azimuth = sincos_turns(around - floorR(around));
    Real level = 2.f * sine * cosine, up = R(1.) - lost;
    s.w = v3(azimuth.sine * level, sel(s.place.south, -up, up), -(azimuth.cosine * level));
    return s;
}

FN vec3 sky_to_world(Light l, vec3 w) {
    return add3(scale3(light_a(l), w.x), add3(scale3(light_b(l), w.y), scale3(light_c(l), w.z)));
}
FN vec3 sky_from_world(Light l, vec3 w) {
    return v3(dot3(light_a(l), w), dot3(light_b(l), w), dot3(light_c(l), w));
}
