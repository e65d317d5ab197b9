// Random numbers as a function of (seed, pixel, sample, set) alone: the image cannot depend on how
// work is split. Which set is for which decision says draws.h.

typedef struct {
    Uint x, y, z, w;
} Random4;

/// PCG4D hash (Jarzynski and Olano 2020, "Hash functions for GPU rendering", JCGT 9(3)): four
/// 32-bit numbers.
FN Random4 random4(Uint pixel, Uint sample, Uint set, Uint seed) {
    Random4 v;
    v.x = pixel * 1664525u + 1013904223u;
    v.y = sample * 1664525u + 1013904223u;
    v.z = set * 1664525u + 1013904223u;
    v.w = seed * 1664525u + 1013904223u;
    v.x += v.y * v.w;
    v.y += v.z * v.x;
    v.z += v.x * v.y;
    v.w += v.y * v.z;
    v.x ^= v.x >> 16;
    v.y ^= v.y >> 16;
    v.z ^= v.z >> 16;
    v.w ^= v.w >> 16;
    v.x += v.y * v.w;
    v.y += v.z * v.x;
    v.z += v.x * v.y;
    v.w += v.y * v.z;
    return v;
}

/// Uniform in [0, 1) on a grid of 2^-24: never 1.
FN Real uniform01(Uint x) { return toReal(asInt(x >> 8)) * R(5.9604644775390625e-8); }
FN vec2 uniform2(Uint x, Uint y) { return v2(uniform01(x), uniform01(y)); }
