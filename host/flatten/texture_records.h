// The textures of a scene as the device reads them.
#pragma once

#include "host/flatten/device_scene.h"
#include "host/scene/scene.h"

#include <memory>
#include <span>
#include <vector>

namespace parhelion {

/// Textures that parameters of materials name, each once, and a sky's image, in the order of the
/// device's rows.
std::vector<std::shared_ptr<const Texture>> textures_of(const Scene& scene);

/// Reads texels and adds the records of textures, and for each material which it has; none where
/// nothing of the image asks for materials. Throws InputError for an image that cannot be read, and
/// for values that the parameter they are for cannot take. `before`: as flatten_scene has it.
void add_textures(const Scene& scene, DeviceScene* before, DeviceScene& out);

/// Materials whose lobes lie along texture coordinates.
std::size_t count_anisotropic(const DeviceScene& records);
inline bool has_anisotropic(const DeviceScene& records) { return count_anisotropic(records) > 0; }

/// All but that of a sky, which is the last.
std::span<const TextureRecord> textures_by_place(const DeviceScene& records);
/// Of those all but what lights without size shine through, which are the last.
std::span<const TextureRecord> surface_textures(const DeviceScene& records);
std::size_t projected_textures(const DeviceScene& records);

/// Whether texture coordinates are read: asked for as an AOV, or by textures.
bool reads_uvs(const Scene& scene, const DeviceScene& records);

/// What bytes of texels stand for: BYTE_VALUES numbers, correctly rounded.
std::vector<float> make_byte_values();

} // namespace parhelion
