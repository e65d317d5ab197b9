// How a channel of an image file is stored.
#pragma once

namespace parhelion {

enum class ComponentFormat { float16, float32, uint32 };

} // namespace parhelion
