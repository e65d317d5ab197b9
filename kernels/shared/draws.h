// Which decisions of a path take random numbers. Each takes a set of four, by the number of the set
// alone (sampler.h): sets that nobody asks for cost nothing, so there is room between them, and a
// decision to come moves none of the others.

// Once a path: position on the film and on the lens; the moment (kept free).
#define CAMERA_DRAWS(X) X(camera) X(time)
// Once a bounce: which light (two integers) and where on it; the BSDF's direction (two), its choice
// and Russian roulette. Kept free: which lobe of several, whether a surface is there at all, how
// far a ray gets in a medium, and where it is scattered to.
#define BOUNCE_DRAWS(X) X(emitter) X(bsdf) X(lobe) X(opacity) X(medium) X(phase)

#define CAMERA_SETS 8
#define BOUNCE_SETS 8

#define DRAW_ENUM(name) draw_##name,
enum CameraDraw { CAMERA_DRAWS(DRAW_ENUM) camera_draw_count };
enum BounceDraw { BOUNCE_DRAWS(DRAW_ENUM) bounce_draw_count };
#ifndef __OPENCL_C_VERSION__
static_assert(camera_draw_count <= CAMERA_SETS && bounce_draw_count <= BOUNCE_SETS);
#endif

/// The set of a decision at the vertex that `depth` others lie before.
FN Uint bounce_set(int depth, int draw) {
    return asUint((Int)(CAMERA_SETS + depth * BOUNCE_SETS + draw));
}
