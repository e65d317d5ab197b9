// Between which values a texture stays.
#pragma once

#include "host/scene/texture.h"

#include <cstddef>
#include <span>

namespace parhelion {

struct ValueBounds {
    double lowest, highest; ///< of all components; not finite where some component is not
};

ValueBounds bounds_of_values(std::span<const float> values);

/// `texels`: of an image, as the device reads them.
ValueBounds texture_bounds(const Texture& texture, std::span<const std::byte> texels);

} // namespace parhelion
