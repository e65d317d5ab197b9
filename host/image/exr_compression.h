// How the pixels of an OpenEXR file can be packed.
#pragma once

#include <array>

namespace parhelion {

// clang-format off
/// Name; OpenEXR's name of it; what it loses: nothing, or of which channels it does.
#define EXR_COMPRESSIONS(X)                                                                        \
    X(none, NO, nothing) X(rle, RLE, nothing) X(zips, ZIPS, nothing) X(zip, ZIP, nothing)          \
    X(piz, PIZ, nothing) X(pxr24, PXR24, of_floats) X(b44, B44, of_halves) X(b44a, B44A, of_halves) \
    X(dwaa, DWAA, of_colors) X(dwab, DWAB, of_colors)
// clang-format on

#define EXR_COMPRESSION_ENUM(name, ...) name,
enum class ExrCompression { EXR_COMPRESSIONS(EXR_COMPRESSION_ENUM) };
#define EXR_COMPRESSION_NAME(name, ...) #name,
inline constexpr std::array exr_compression_names{EXR_COMPRESSIONS(EXR_COMPRESSION_NAME)};

/// `of_floats`: 8 of their 32 bits; `of_halves`: 4x4 of them are kept in 14 bytes; `of_colors`:
/// channels whose names end in R, G, B or Y, by how well they are seen.
enum class ExrLoss { nothing, of_floats, of_halves, of_colors };
#define EXR_COMPRESSION_LOSS(name, exr_name, loss) ExrLoss::loss,
inline constexpr std::array exr_losses{EXR_COMPRESSIONS(EXR_COMPRESSION_LOSS)};

} // namespace parhelion
