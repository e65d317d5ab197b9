// An image to a file of the format that its name asks for.
#include "host/image/write_image.h"

#include "host/image/png.h"

namespace parhelion {

std::vector<Misfits> write_image(const std::string& file, const ImageRows& image,
                                 const WriteOptions& options) {
    return image_format(file) == ImageFormat::png
               ? write_png(file, image, options.exposure, options.exr.existing)
               : write_exr(file, image, options.exr);
}

} // namespace parhelion
