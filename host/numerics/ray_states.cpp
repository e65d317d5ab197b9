// Rays laid out as the stages `intersect` and `shadow` find them, and what those left of them.
#include "host/numerics/ray_states.h"

#include "kernels/device/buffers.h"

#include <algorithm>
#include <bit>
#include <stdexcept>

namespace parhelion::numerics {
namespace {

/// A state of so many fields with what paths and shadow rays both begin with, and their slots.
std::vector<float> state_of(std::span<const TracedRay> rays, const RayLayout& layout, int fields,
                            int slot) {
    std::vector<float> state(static_cast<std::size_t>(fields) * layout.stride);
    for (std::size_t i = 0; i < rays.size(); i++) {
        auto word = [&](int field) -> float& {
            return state[static_cast<std::size_t>(field) * layout.stride + layout.place(i)];
        };
        for (int axis = 0; axis < 3; axis++) {
            word(ray_origin + axis) = rays[i].origin[static_cast<std::size_t>(axis)];
            word(ray_direction + axis) = rays[i].direction[static_cast<std::size_t>(axis)];
        }
        word(ray_t) = rays[i].t_max;
        word(ray_excluded) = std::bit_cast<float>(rays[i].excluded);
        word(slot) = std::bit_cast<float>(static_cast<int>(i));
    }
    return state;
}

} // namespace

std::vector<int> segment_counts(const RayLayout& layout) {
    std::vector<int> entries(2 * layout.segments);
    for (std::size_t i = 0; i < entries.size(); i++) {
        std::size_t before = std::min(layout.rays, i / 2 * layout.size);
        entries[i] = static_cast<int>(std::min(layout.size, layout.rays - before));
    }
    return entries;
}

std::vector<float> path_state(std::span<const TracedRay> rays, const RayLayout& layout) {
    return state_of(rays, layout, path_word_count, path_slot);
}

std::vector<float> shadow_state(std::span<const TracedRay> rays, const RayLayout& layout) {
    std::vector<float> state = state_of(rays, layout, shadow_word_count, shadow_slot);
    for (std::size_t i = 0; i < rays.size(); i++)
        for (std::size_t channel = 0; channel < 3; channel++)
            state[(shadow_contribution + channel) * layout.stride + layout.place(i)] =
                static_cast<float>(1 << channel);
    return state;
}

std::vector<TracedHit> read_hits(std::span<const float> path_state, const RayLayout& layout) {
    std::vector<TracedHit> hits(layout.rays);
    for (std::size_t i = 0; i < layout.rays; i++) {
        auto word = [&](std::size_t field) {
            return path_state[field * layout.stride + layout.place(i)];
        };
        hits[i] = {word(path_t), word(path_b1), word(path_b2),
                   std::bit_cast<int>(word(path_primitive))};
    }
    return hits;
}

std::vector<bool> read_blocked(std::span<const float> results, std::size_t rays,
                               std::size_t stride) {
    std::vector<bool> blocked(rays);
    for (std::size_t i = 0; i < rays; i++) {
        float r = results[result_r * stride + i], g = results[result_g * stride + i],
              b = results[result_b * stride + i];
        blocked[i] = r == 0;
        if (g != 2 * r || b != 4 * r || (r != 0 && r != 1))
            throw std::runtime_error("wrong radiance arrived");
    }
    return blocked;
}

} // namespace parhelion::numerics
