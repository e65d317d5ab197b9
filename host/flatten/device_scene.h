// The scene as the device reads it: flat arrays of the records in kernels/shared/types.h.
#pragma once

#include "host/bvh/bvh.h"
#include "host/file_stamp.h"
#include "host/flatten/feature_decisions.h"
#include "host/flatten/scene_frame.h"
#include "host/large_vector.h"
#include "host/scene/scene.h"
#include "kernels/device/buffers.h"
#include "kernels/shared/types.h"

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace parhelion {

struct LightTree {
    std::vector<LightNodeRecord> nodes; ///< siblings side by side, the root itself left out
    std::vector<int> leaves;            ///< the node of each light
};

/// The image of a sky; all means nothing where there is none.
struct Environment {
    int texture = -1; ///< its row
    /// Of its cells (kernels/device/environment.h), of a sunsky behind its words.
    LargeVector<int> shares;
    bool sun = false;  ///< a sunsky has one
    double mean = 0.0; ///< of its components, over all directions
    double peak = 0.0; ///< largest component
};

/// Whence some of the texels are.
struct ImageOrigin {
    std::string name;
    TexelLayout layout;
    bool decoded = false;           ///< 16 bits of sRGB, made linear
    std::optional<FileStamp> stamp; ///< nothing where it is no file
    std::size_t first = 0;          ///< word

    bool operator==(const ImageOrigin&) const = default;
};

/// How one of many lights is chosen: by what it may send to the point to be lit, or by its power
/// alone.
enum class LightChoice { importance, power };

/// All places and lengths are in the units of `frame`, about its centre.
struct DeviceScene {
    SceneFrame frame;
    IndexedGeometry geometry; ///< its shapes are those of the scene
    std::vector<MaterialRecord> materials;
    std::vector<LobeRecord> lobes;                         ///< lists, one behind the other
    std::vector<MaterialTexturesRecord> material_textures; ///< a row a material
    std::vector<int> blend_textures;    ///< of the scene's blends: row of their weight; -1: none
    std::vector<int> radiance_textures; ///< of the scene's shapes, likewise
    std::vector<int> emitter_textures;  ///< of what its emitters shine through, likewise
    std::vector<Rgb> texture_means;     ///< of `textures`, where some light has one
    std::vector<TextureRecord> textures;
    LargeVector<int> texels;
    std::vector<ImageOrigin> images; ///< of the first of them
    std::vector<float> byte_values;  ///< BYTE_VALUES of them where there are texels of bytes
    std::vector<LightRecord> lights;
    std::vector<int> light_textures; ///< empty where no light has one
    std::vector<int> light_groups;   ///< empty where none are asked for
    LightTree light_tree;            ///< empty where there is only one light
    Environment environment;
    std::vector<float> energy_tables; ///< one behind the other; materials know their first
    std::vector<FilterBin> filter_table;
    std::vector<float> filter_values;
    Bvh bvh;
    BvhStatistics bvh_statistics;
    int camera_root = 0; ///< differs from root where emitters are hidden from the camera
    int root = 0;
    int blocking_root = 0; ///< of what shadow rays cannot go through; differs from root where there
                           ///< is something else
    int clear_root = 0;    ///< of that
    int sky_light = -1;    ///< row of the light table
    FeatureDecisions features;      ///< what the kernels must have, and why
    std::vector<std::string> notes; ///< what single precision makes of the scene that the user
                                    ///< should be told, one line each; beside Scene::notes

    /// Of all arrays that kernels read.
    std::size_t bytes() const;
};

/// All of it but the BVH: what may be wrong with a scene is seen here. Throws InputError, among
/// others where the scene is larger than the device's 32-bit indices.
/// `before`, where there is one, is of another scene: texels of files that have not changed since
/// are taken from it.
DeviceScene flatten_scene(const Scene& scene, LightChoice choice = LightChoice::importance,
                          DeviceScene* before = nullptr);

/// Flattens a scene and builds its BVH. Throws as flatten_scene does.
DeviceScene make_device_scene(const Scene& scene, LightChoice choice = LightChoice::importance,
                              DeviceScene* before = nullptr);

/// Of a shape; 0 for a mesh without triangles.
std::size_t primitive_count(const Shape& shape);

/// 1 / |cross(u, v)| as records keep it: 0 where the plane of u and v is none that floats know.
float inverse_normal_length(const glm::dvec3& u, const glm::dvec3& v);

} // namespace parhelion
