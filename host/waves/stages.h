// The stages of the wavefront pipeline: their list, and the features each of their kernels can make
// use of.
#pragma once

#include "host/feature_set.h"

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
    int tracing_lanes = 0; ///< of the program that walks the tree; 0: as many
    bool portable = false;
    FeatureSet features{};
    int work_group_size = 1;
    bool checked = false; ///< kernels look after the bounds of buffers (kernels/device/bounds.h)
};

constexpr int lanes_of(ProgramGroup group, const StageOptions& options) {
    const bool own = group == ProgramGroup::tracing && options.tracing_lanes > 0;
    return own ? options.tracing_lanes : options.lanes;
}

/// What surfaces are made of, for those that let light through.
constexpr FeatureSet clear_surface_features() {
#define TEXTURE_FEATURE(name, Name) feature_texture_##name,
    constexpr FeatureSet textures{TEXTURES(TEXTURE_FEATURE)};
    return textures | FeatureSet{feature_clear_shadows, feature_blends,
                                 feature_textures,      feature_textured_blends,
                                 feature_texels_byte,   feature_texels_half,
                                 feature_texels_single, feature_vertex_normals,
                                 feature_vertex_uvs,    feature_analytic_uvs};
}

/// The features of a scene that can change the stage's program; the rest would only make more
/// programs of the same content.
constexpr FeatureSet stage_features(Stage stage, const FeatureSet& scene) {
#define SHAPE_FEATURE(name) feature_shape_##name,
    constexpr FeatureSet shapes{GEOMETRIES(SHAPE_FEATURE)};
    constexpr FeatureSet streams{feature_ray_streams};
    constexpr FeatureSet film{feature_filter_splatting, feature_filter_sampling};
    constexpr FeatureSet film_only{feature_moments, feature_variance};
    constexpr FeatureSet camera{feature_thin_lens, feature_far_camera};
    switch (stage) {
    case Stage::generate:
        return film | camera |
               FeatureSet{feature_faure, feature_replicates, feature_clear_shadows,
                          feature_shape_ids};
    case Stage::shadow:
        return shapes | streams | FeatureSet{feature_light_groups} |
               (scene.has(feature_clear_shadows) ? clear_surface_features() : FeatureSet{});
    case Stage::intersect:
        return shapes | streams;
    case Stage::accumulate:
        return FeatureSet{feature_filter_splatting} | film_only;
    case Stage::shade:
        // Where a shape is told depends on what the film has before.
        return FeatureSet::all() -
               (scene.has(feature_shape_ids) ? FeatureSet{feature_filter_sampling} : film) -
               streams - FeatureSet{feature_thin_lens} - film_only;
    }
    return {};
}

} // namespace parhelion
