// LDR-FLIP: how different two images look when one flips between them.
#pragma once

#include <span>
#include <vector>

namespace parhelion {

/// 0.7 m from a 3840 pixel, 0.7 m wide screen: the viewing condition FLIP is published with.
inline constexpr double flip_default_pixels_per_degree = 67.0206432765823; // 3840 pi / 180

/// Planes of linear sRGB, row-major; values outside [0, 1] are clamped, as a screen would.
struct LinearRgb {
    std::span<const float> r, g, b;
};

/// Error of each pixel, 0 (the same) to 1. P. Andersson, J. Nilsson, T. Akenine-Moeller, M.
/// Oskarsson, K. Astroem, M. D. Fairchild: "FLIP: A Difference Evaluator for Alternating Images",
/// HPG 2020. Throws std::invalid_argument for planes of a wrong length, values that are not finite,
/// or pixels_per_degree that is not positive and finite.
std::vector<double> flip_error(const LinearRgb& image, const LinearRgb& reference, int width,
                               int height,
                               double pixels_per_degree = flip_default_pixels_per_degree);

} // namespace parhelion
