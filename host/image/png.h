// PNG previews of linear images.
#pragma once

#include "host/image/image_rows.h"
#include "host/image/misfits.h"
#include "host/image/output.h"

#include <string>
#include <vector>

namespace parhelion {

/// Writes the main layer (R, G, B; or X, Y, Z; or Y alone, as grey) as 8-bit sRGB: values times
/// 2^exposure, cut off at 0 and 1, then the sRGB transfer function. No filmic curve, so that a
/// value below 1 can be read back from the preview, as in most renderers. Alpha is not used: the
/// picture is over black. A pixel that is not finite becomes magenta. Metadata are texts of the
/// file (png_attribute). The file appears whole or not at all, as PendingFile says. Returns, for
/// each channel of the main layer that has some, how many values are not finite; what is cut off is
/// no misfit. Throws OutputError where the folder or the disk refuses, InputError where the image
/// has none of these channels.
[[nodiscard]] std::vector<Misfits> write_png(const std::string& file, const ImageRows& image,
                                             double exposure = 0.0,
                                             Existing existing = Existing::replace);
[[nodiscard]] inline std::vector<Misfits> write_png(const std::string& file, const Image& image,
                                                    double exposure = 0.0,
                                                    Existing existing = Existing::replace) {
    return write_png(file, WholeImage(image), exposure, existing);
}

} // namespace parhelion
