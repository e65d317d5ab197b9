// The film: what of an image is kept, and the filter that reconstructs it.
#pragma once

#include "host/image/component_format.h"

#include <array>

namespace parhelion {

enum class PixelFormat { luminance, luminance_alpha, rgb, rgba, xyz, xyza };

#define FILTER_KINDS(X) X(box) X(tent) X(gaussian) X(mitchell) X(catmullrom) X(lanczos)
#define FILTER_KIND_ENUM(name) name,
enum class FilterKind { FILTER_KINDS(FILTER_KIND_ENUM) };

/// Separable reconstruction filter; the parameters a kind does not have are unused.
struct ReconstructionFilter {
    FilterKind kind = FilterKind::gaussian;
    double radius = 0.0; ///< tent; 0: the kind's default
    double stddev = 0.5; ///< gaussian, pixels
    double mitchell_a = 1.0 / 3.0,
           mitchell_b = 1.0 / 3.0; ///< Mitchell and Netravali's B and C, named so in the file
    int lanczos_lobes = 3;
};

/// Whether some of its values are below 0.
inline bool has_negative_values(FilterKind kind) {
    return kind != FilterKind::box && kind != FilterKind::tent && kind != FilterKind::gaussian;
}

/// How a filter wider than a pixel is applied: a sample counts for every pixel that the filter
/// reaches, or it lies where the filter has put it and counts for one pixel alone.
#define FILTER_METHODS(X) X(splatting) X(sampling)
#define METHOD_ENUM(name) name,
enum class FilterMethod { FILTER_METHODS(METHOD_ENUM) };
#define METHOD_NAME(name) #name,
inline constexpr std::array filter_method_names{FILTER_METHODS(METHOD_NAME)};

struct Film {
    int width = 768, height = 576;
    int crop_x = 0, crop_y = 0, crop_width = 0, crop_height = 0; ///< 0 x 0: the whole film
    PixelFormat pixel_format = PixelFormat::rgb;
    ComponentFormat component_format = ComponentFormat::float32;
    bool sample_border = false; ///< the filter also reaches for light beyond the edge of the film
    ReconstructionFilter filter;
    FilterMethod filter_method = FilterMethod::splatting;
};

} // namespace parhelion
