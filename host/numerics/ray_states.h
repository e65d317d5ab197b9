// Rays laid out as the stages `intersect` and `shadow` find them, and what those left of them.
#pragma once

#include <array>
#include <limits>
#include <span>
#include <vector>

namespace parhelion::numerics {

struct TracedRay {
    std::array<float, 3> origin, direction;
    float t_max = std::numeric_limits<float>::infinity();
    int excluded = -1; ///< the primitive it leaves
};

struct TracedHit {
    float t, b1, b2;
    int primitive; ///< -1: nothing

    bool operator==(const TracedHit&) const = default;
};

/// Where so many rays stand: segments of `size`, each with room for `pitch`, and fields of a state
/// `stride` words apart.
struct RayLayout {
    std::size_t rays, segments, size, pitch, stride;

    std::size_t place(std::size_t ray) const { return ray / size * pitch + ray % size; }
};

/// Entries of each segment, twice: of paths and of shadow rays.
std::vector<int> segment_counts(const RayLayout& layout);

std::vector<float> path_state(std::span<const TracedRay> rays, const RayLayout& layout);

/// Ray i brings the radiance (1, 2, 4) to slot i.
std::vector<float> shadow_state(std::span<const TracedRay> rays, const RayLayout& layout);

std::vector<TracedHit> read_hits(std::span<const float> path_state, const RayLayout& layout);

/// Whether something was in a ray's way; `results` had zeros before, its fields `stride` words
/// apart. Throws std::runtime_error where a ray's radiance has not arrived as it was.
std::vector<bool> read_blocked(std::span<const float> results, std::size_t rays,
                               std::size_t stride);

} // namespace parhelion::numerics
