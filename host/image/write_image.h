// An image to a file of the format that its name asks for.
#pragma once

#include "host/image/exr.h"

namespace parhelion {

struct WriteOptions {
    double exposure = 0.0; ///< of a preview, in stops
    ExrOptions exr;        ///< what is said of existing files holds for both formats
};

/// As write_png or write_exr does, returning what they return. Throws what they throw, and
/// InputError for a name that asks for neither.
[[nodiscard]] std::vector<Misfits> write_image(const std::string& file, const ImageRows& image,
                                               const WriteOptions& options);

} // namespace parhelion
