// The stages of the wavefront pipeline: their list, and the features each of their kernels can make
// use of.
#pragma once

#include "host/render/device_scene.h"

#include <array>
#include <string>

namespace parhelion {

// name of the kernel and of its file, program it is compiled in
#define STAGES(X)                                                                                  \
    X(generate, shading)                                                                           \
    X(intersect, tracing) X(shade, shading) X(shadow, tracing) X(accumulate, tracing)

// Compiling has a cost for each program beside that of its kernels, and two can be compiled at
// once: those that walk the BVH are one, what changes with every scene's materials is the other.
// Generate and accumulate are where both then take equally long (the Cornell box).
#define PROGRAM_GROUPS(X) X(tracing) X(shading)

#define GROUP_ENUM(name) name,
enum class ProgramGroup { PROGRAM_GROUPS(GROUP_ENUM) };
#define GROUP_VALUE(name) ProgramGroup::name,
inline constexpr std::array program_groups{PROGRAM_GROUPS(GROUP_VALUE)};
#define GROUP_NAME(name) #name,
inline constexpr std::array program_group_names{PROGRAM_GROUPS(GROUP_NAME)};

#define STAGE_ENUM(name, group) name,
enum class Stage { STAGES(STAGE_ENUM) };
#define STAGE_NAME(name, group) #name,
inline constexpr std::array stage_names{STAGES(STAGE_NAME)};
#define STAGE_GROUP(name, group) ProgramGroup::group,
inline constexpr std::array stage_groups{STAGES(STAGE_GROUP)};
inline constexpr std::size_t stage_count = stage_names.size();

/// What programs are compiled for.
struct StageOptions {
    int lanes = 1;
    bool portable = false;
    std::uint64_t features = 0;
    int work_group_size = 1;
    bool checked = false; ///< kernels look after the bounds of buffers (kernels/device/bounds.h)
};

/// The part of a feature mask that can change the stage's program; the rest would only make more
/// programs of the same content.
constexpr std::uint64_t stage_features(Stage stage) {
#define SHAPE_BIT(name) | feature_bit(feature_shape_##name)
    constexpr std::uint64_t shapes = 0 GEOMETRIES(SHAPE_BIT);
    constexpr std::uint64_t splatting = feature_bit(feature_filter_splatting);
    constexpr std::uint64_t film = splatting | feature_bit(feature_filter_sampling);
    constexpr std::uint64_t film_only =
        feature_bit(feature_moments) | feature_bit(feature_variance);
    constexpr std::uint64_t streams = feature_bit(feature_ray_streams);
    switch (stage) {
    case Stage::generate:
        return film | feature_bit(feature_thin_lens) | feature_bit(feature_far_camera) |
               feature_bit(feature_sobol);
    case Stage::intersect:
    case Stage::shadow:
        return shapes | streams;
    case Stage::accumulate:
        return splatting | film_only;
    case Stage::shade:
        return ~(film | streams | feature_bit(feature_thin_lens) | film_only);
    }
    return 0;
}

} // namespace parhelion
