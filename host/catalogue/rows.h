// The rows of the catalogue that are no plain test of one function.
#pragma once

#include "host/catalogue/stress_run.h"

namespace parhelion::stress {

// name, ways (Ways), chapter, title
// clang-format off
#define STRESS_ROWS(X)                                                                             \
    X(one_argument, one, "Functions", "Functions of one number, at every float of their domain (quick: at some of those below 2^-32)")      \
    X(same_bits, every, "Functions", "Host and device compute the same bits: every shared function on wild inputs") \
    X(leaks, every, "Rays", "Rays at edges and corners of closed meshes never get out")          \
    X(brute_force, every, "Rays", "The tree finds what trying every primitive finds")                  \
    X(degenerate_triangles, one, "Rays", "Triangles of no area are never hit, needles keep a mesh closed") \
    X(long_triangles, one, "Rays", "Closed meshes of long, thin and huge triangles leak nothing, through 1, 8 and 16 lanes alike") \
    X(random_triangles, one, "Rays", "Random triangles up to 1e8 times as long as wide: the hits of double precision, through 1, 8 and 16 lanes alike") \
    X(doubled_faces, one, "Rays", "Of two faces at one place that look opposite ways the ray hits the one that faces it") \
    X(self_hits, one, "Rays", "Rays that leave a triangle hit neither it nor what lies in its plane") \
    X(occlusion, one, "Rays", "Shadow rays are blocked by what is in their way and by nothing else") \
    X(nested_spheres, one, "Rays", "Of two spheres 4e-6 apart the nearer one shows") \
    X(light_tables, one, "Statistics", "Lights of very unequal power, and filters: shares, draws and densities agree") \
    X(skies, one, "Statistics", "Skies of images: what is seen, which directions are chosen, with which density") \
    X(daylight, one, "Statistics", "The sun and the sky by their formula: what is seen, which directions are chosen, with which density") \
    X(accumulation, one, "Sums", "A pixel's mean and variance do not drift with its samples") \
    X(density, one, "Statistics", "Samples of every material follow its density (chi-square, Sidak)") \
    X(sampling_ends, one, "Statistics", "Every sampling routine at the ends of its random numbers: finite, with a density or no sample") \
    X(roulette, one, "Statistics", "With Russian roulette and without it images have the same mean") \
    X(furnace, one, "Statistics", "No material returns more than it receives") \
    X(white_furnace, one, "Statistics", "Rough materials with energy compensation return what they receive") \
    X(shading_normals, one, "Images", "Coarse spheres with smooth normals: no light from below the true surface, no more than there is") \
    X(splitting, one, "Images", "The image is the same bits however the work is split") \
    X(kernels, one, "Images", "The image is the same bits whatever kernels make it") \
    X(crops, one, "Images", "A crop has the bits of the whole image") \
    X(scale_and_move, one, "Images", "A scene scaled by a power of two or moved exactly gives the same bits") \
    X(scale_and_turn, one, "Images", "A scene of any other size, turned: the same means (Welch)") \
    X(grain_and_planet, one, "Images", "Grains of 1e-6 to 1e6 on a planet of 1e7: device against double precision") \
    X(small_and_far, one, "Images", "Lights down to 1e-18 wide, things looked at from up to 1e12: closed forms") \
    X(closed_forms, one, "Images", "Scenes of known answers over many seeds: no bias, and errors as large as they say")
// clang-format on

#define DECLARE_ROW(name, ways, chapter, title) Checks row_##name(StressRun& run);
STRESS_ROWS(DECLARE_ROW)

} // namespace parhelion::stress
