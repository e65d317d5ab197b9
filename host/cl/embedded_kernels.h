// The kernel sources that were put into the program at build time.
#pragma once

#include <span>
#include <string_view>

namespace parhelion {

struct EmbeddedFile {
    std::string_view path; ///< relative to kernels/, e.g. "shared/math.h"
    std::string_view text; ///< the whole file, unchanged
};

/// Every .cl and .h file below kernels/, sorted by path. The text lives as long as the program.
std::span<const EmbeddedFile> embedded_kernels();

} // namespace parhelion
