// The mean of a texture, what of its values makes a light bright; and the highest of them.
#pragma once

#include "host/scene/texture.h"

#include <cstddef>
#include <span>

namespace parhelion {

/// Of all texels, of the colours of a checkerboard; of what meshes have, 1: any will do where it
/// tells only which lights are looked at more often. `texels`: of an image, as the device reads
/// them.
Rgb texture_mean(const Texture& texture, std::span<const std::byte> texels);

/// Of each component; of what meshes have likewise 1.
Rgb texture_highest(const Texture& texture, std::span<const std::byte> texels);

} // namespace parhelion
