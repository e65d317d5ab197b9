// Attributes of meshes as textures look them up.
#pragma once

#include "host/flatten/device_scene.h"

#include <span>
#include <string>
#include <vector>

namespace parhelion {

/// What a mesh_attribute texture looks up: words that stand behind each other in `texels`.
struct AttributeTexels {
    std::vector<float> values; ///< three of each face, or of each corner of it; scaled
    std::vector<int>
        shapes;       ///< where each shape's begin, less what stands for primitives before it
    bool grey = true; ///< all have one channel
};

/// Of the shapes whose materials look it up, by row `row` of the textures; `first_word`: where
/// `values` will stand. Throws InputError for a shape that has no such attribute.
AttributeTexels attribute_texels(const Scene& scene, const DeviceScene& records,
                                 const MeshAttributeTexture& attribute, int row,
                                 std::size_t first_word);

} // namespace parhelion
