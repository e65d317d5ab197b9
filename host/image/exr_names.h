// OpenEXR's own names of what a file is written as.
#pragma once

#include "host/image/component_format.h"
#include "host/image/exr_compression.h"

#include <ImfCompression.h>
#include <ImfPixelType.h>
#include <array>

namespace parhelion {

#define EXR_COMPRESSION_NUMBER(name, exr_name, loss) Imf::exr_name##_COMPRESSION,
inline Imf::Compression exr_compression(ExrCompression compression) {
    constexpr std::array numbers{EXR_COMPRESSIONS(EXR_COMPRESSION_NUMBER)};
    return numbers[static_cast<std::size_t>(compression)];
}

/// In the order of ComponentFormat.
inline Imf::PixelType exr_component(ComponentFormat component) {
    constexpr std::array types{Imf::HALF, Imf::FLOAT, Imf::UINT};
    return types[static_cast<std::size_t>(component)];
}

} // namespace parhelion
