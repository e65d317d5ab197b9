// The FLIP pipeline: spatial filters of the eye, colour difference, feature difference,
// combination.
#include "host/image/flip.h"

#include "host/image/srgb.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <stdexcept>

namespace parhelion {

namespace {

using Plane = std::vector<double>;
using Planes = std::array<Plane, 3>;
using Color = std::array<double, 3>;
using std::numbers::pi;

// ---- colour spaces

/// Linear sRGB to XYZ: exact, from the chromaticities of the sRGB primaries and of D65.
constexpr Matrix3 srgb_to_xyz{
    {{10135552.0 / 24577794.0, 8788810.0 / 24577794.0, 4435075.0 / 24577794.0},
     {2613072.0 / 12288897.0, 8788810.0 / 12288897.0, 887015.0 / 12288897.0},
     {1425312.0 / 73733382.0, 8788810.0 / 73733382.0, 70074185.0 / 73733382.0}}};

Color white() { return transform(srgb_to_xyz, {1.0, 1.0, 1.0}); }

/// Opponent space whose channels the eye filters apart: luminance, red-green, blue-yellow.
Color linear_to_opponent(const Color& rgb) {
    const Color xyz = transform(srgb_to_xyz, rgb), w = white();
    const double x = xyz[0] / w[0], y = xyz[1] / w[1], z = xyz[2] / w[2];
    return {116.0 * y - 16.0, 500.0 * (x - y), 200.0 * (y - z)};
}

Color opponent_to_linear(const Color& opponent, const Matrix3& xyz_to_linear) {
    const Color w = white();
    const double y = (opponent[0] + 16.0) / 116.0;
    const double x = y + opponent[1] / 500.0, z = y - opponent[2] / 200.0;
    return transform(xyz_to_linear, {x * w[0], y * w[1], z * w[2]});
}

/// CIE L*a*b* with a and b scaled by 0.01 L: the Hunt effect, colours fade in the dark.
Color linear_to_hunt_lab(const Color& rgb) {
    const auto f = [](double t) {
        constexpr double delta = 6.0 / 29.0;
        return t > delta * delta * delta ? std::cbrt(t) : t / (3.0 * delta * delta) + 4.0 / 29.0;
    };
    const Color xyz = transform(srgb_to_xyz, rgb), w = white();
    const double fx = f(xyz[0] / w[0]), fy = f(xyz[1] / w[1]), fz = f(xyz[2] / w[2]);
    const double lightness = 116.0 * fy - 16.0;
    return {lightness, 0.01 * lightness * 500.0 * (fx - fy), 0.01 * lightness * 200.0 * (fy - fz)};
}

/// City-block in lightness, Euclidean in colour: made for large differences.
double hyab(const Color& a, const Color& b) {
    return std::abs(a[0] - b[0]) + std::hypot(a[1] - b[1], a[2] - b[2]);
}

// ---- convolution

/// A separable filter is two of these; the middle entry is the pixel itself.
using Taps = std::vector<double>;

struct Size {
    int width, height;
};

/// Filters along x (`along_x`) or y; pixels beyond the border repeat the border.
Plane convolve_1d(const Plane& plane, Size size, const Taps& taps, bool along_x) {
    const int radius = static_cast<int>(taps.size() / 2);
    const int length = along_x ? size.width : size.height;
    const int lines = along_x ? size.height : size.width;
    const std::size_t step = along_x ? 1 : size.width, line_step = along_x ? size.width : 1;
    Plane out(plane.size());
    for (int line = 0; line < lines; ++line) {
        const std::size_t base = line * line_step;
        for (int i = 0; i < length; ++i) {
            double sum = 0.0;
            for (int k = -radius; k <= radius; ++k)
                sum += taps[k + radius] * plane[base + std::clamp(i + k, 0, length - 1) * step];
            out[base + i * step] = sum;
        }
    }
    return out;
}

Plane convolve(const Plane& plane, Size size, const Taps& taps_x, const Taps& taps_y) {
    return convolve_1d(convolve_1d(plane, size, taps_x, true), size, taps_y, false);
}

Taps make_taps(int radius, const auto& function) {
    Taps taps;
    for (int i = -radius; i <= radius; ++i)
        taps.push_back(function(i));
    return taps;
}

double sum(const Taps& taps) {
    double total = 0.0;
    for (const double tap : taps)
        total += tap;
    return total;
}

// ---- filters of the eye

/// Contrast sensitivity in the frequency domain as Gaussians a exp(-pi^2 d^2 / b) (d in degrees).
struct Gaussian {
    double a, b;
};
constexpr Gaussian luminance_gaussian{1.0, 0.0047}, red_green_gaussian{1.0, 0.0053};
constexpr std::array<Gaussian, 2> blue_yellow_gaussians{{{34.1, 0.04}, {13.5, 0.025}}};

/// All channels use the radius of the widest Gaussian, three standard deviations.
int spatial_radius(double pixels_per_degree) {
    const double widest = blue_yellow_gaussians[0].b;
    return static_cast<int>(
        std::ceil(3.0 * std::sqrt(widest / (2.0 * pi * pi)) * pixels_per_degree));
}

Taps gaussian_taps(double b, double pixels_per_degree) {
    return make_taps(spatial_radius(pixels_per_degree), [&](int i) {
        const double degrees = i / pixels_per_degree;
        return std::exp(-pi * pi * degrees * degrees / b);
    });
}

/// Filters with a sum of Gaussians whose weights together are 1. In two dimensions a Gaussian is
/// the product of two of one, so each term is separable though their sum is not.
template<std::size_t N>
Plane filter_gaussians(const Plane& plane, Size size, const std::array<Gaussian, N>& gaussians,
                       double pixels_per_degree) {
    Plane out(plane.size(), 0.0);
    double weight = 0.0;
    for (const Gaussian& gaussian : gaussians) {
        const Taps taps = gaussian_taps(gaussian.b, pixels_per_degree);
        const double scale = gaussian.a * std::sqrt(pi / gaussian.b);
        weight += scale * sum(taps) * sum(taps);
        const Plane term = convolve(plane, size, taps, taps);
        for (std::size_t i = 0; i < out.size(); ++i)
            out[i] += scale * term[i];
    }
    for (double& value : out)
        value /= weight;
    return out;
}

// ---- colour difference

/// What the eye resolves of the opponent planes, as Hunt-adjusted Lab.
std::vector<Color> perceived_colors(const Planes& opponent, Size size, double pixels_per_degree) {
    const Planes seen{
        filter_gaussians(opponent[0], size, std::array{luminance_gaussian}, pixels_per_degree),
        filter_gaussians(opponent[1], size, std::array{red_green_gaussian}, pixels_per_degree),
        filter_gaussians(opponent[2], size, blue_yellow_gaussians, pixels_per_degree)};
    const Matrix3 xyz_to_linear = inverse(srgb_to_xyz);
    std::vector<Color> colors(opponent[0].size());
    for (std::size_t i = 0; i < colors.size(); ++i) {
        Color rgb = opponent_to_linear({seen[0][i], seen[1][i], seen[2][i]}, xyz_to_linear);
        for (double& value : rgb)
            value = std::clamp(value, 0.0, 1.0);
        colors[i] = linear_to_hunt_lab(rgb);
    }
    return colors;
}

constexpr double color_exponent = 0.7; // q_c

/// Maps the raised distance to [0, 1]: the lower 0.4 of the range to the lower 0.95 of the error.
double redistribute(double raised_distance) {
    constexpr double knee_in = 0.4, knee_out = 0.95; // p_c, p_t
    // The largest distance the space has lies between pure green and pure blue.
    static const double largest =
        std::pow(hyab(linear_to_hunt_lab({0.0, 1.0, 0.0}), linear_to_hunt_lab({0.0, 0.0, 1.0})),
                 color_exponent);
    const double knee = knee_in * largest;
    if (raised_distance < knee) return knee_out / knee * raised_distance;
    return knee_out + (raised_distance - knee) / (largest - knee) * (1.0 - knee_out);
}

// ---- feature difference

/// First or second derivative of a Gaussian, each sign scaled to the sum 1, with the plain
/// Gaussian across, scaled to 1 as well.
struct FeatureTaps {
    Taps derivative, across;
};

double feature_deviation(double pixels_per_degree) {
    constexpr double feature_width = 0.082; // degrees
    return 0.5 * feature_width * pixels_per_degree;
}

FeatureTaps feature_taps(double pixels_per_degree, bool points) {
    const double deviation = feature_deviation(pixels_per_degree);
    const double variance = deviation * deviation;
    const int radius = static_cast<int>(std::ceil(3.0 * deviation));
    const auto gaussian = [&](int i) { return std::exp(-i * i / (2.0 * variance)); };
    Taps derivative = make_taps(radius, [&](int i) {
        return (points ? i * i / variance - 1.0 : static_cast<double>(-i)) * gaussian(i);
    });
    double positive = 0.0, negative = 0.0;
    for (const double tap : derivative)
        (tap > 0.0 ? positive : negative) += tap;
    for (double& tap : derivative)
        tap /= tap > 0.0 ? positive : -negative;
    Taps across = make_taps(radius, gaussian);
    const double total = sum(across);
    for (double& tap : across)
        tap /= total;
    return {derivative, across};
}

/// Strength of edges or points in a luminance plane of [0, 1].
Plane feature_strength(const Plane& luminance, Size size, const FeatureTaps& taps) {
    Plane strength = convolve(luminance, size, taps.derivative, taps.across);
    const Plane vertical = convolve(luminance, size, taps.across, taps.derivative);
    for (std::size_t i = 0; i < strength.size(); ++i)
        strength[i] = std::hypot(strength[i], vertical[i]);
    return strength;
}

struct Features {
    Plane edges, points;
};

Features find_features(const Planes& opponent, Size size, double pixels_per_degree) {
    Plane luminance(opponent[0]);
    for (double& value : luminance)
        value = (value + 16.0) / 116.0;
    return {feature_strength(luminance, size, feature_taps(pixels_per_degree, false)),
            feature_strength(luminance, size, feature_taps(pixels_per_degree, true))};
}

// ---- FLIP

Planes to_opponent(const LinearRgb& rgb, std::size_t count) {
    if (rgb.r.size() != count || rgb.g.size() != count || rgb.b.size() != count)
        throw std::invalid_argument("FLIP: planes of a wrong length");
    Planes planes{Plane(count), Plane(count), Plane(count)};
    for (std::size_t i = 0; i < count; ++i) {
        Color color{rgb.r[i], rgb.g[i], rgb.b[i]};
        for (double& value : color) {
            if (!std::isfinite(value)) throw std::invalid_argument("FLIP: a value is not finite");
            value = std::clamp(value, 0.0, 1.0);
        }
        color = linear_to_opponent(color);
        for (int c = 0; c < 3; ++c)
            planes[c][i] = color[c];
    }
    return planes;
}

} // namespace

std::vector<double> flip_error(const LinearRgb& image, const LinearRgb& reference, int width,
                               int height, double pixels_per_degree) {
    if (width < 1 || height < 1 || !std::isfinite(pixels_per_degree) || pixels_per_degree <= 0.0)
        throw std::invalid_argument("FLIP: bad size or pixels per degree");
    const Size size{width, height};
    const std::size_t count = static_cast<std::size_t>(width) * height;
    const Planes a = to_opponent(image, count), b = to_opponent(reference, count);
    const std::vector<Color> colors_a = perceived_colors(a, size, pixels_per_degree);
    const std::vector<Color> colors_b = perceived_colors(b, size, pixels_per_degree);
    const Features features_a = find_features(a, size, pixels_per_degree);
    const Features features_b = find_features(b, size, pixels_per_degree);
    std::vector<double> error(count);
    for (std::size_t i = 0; i < count; ++i) {
        const double color = redistribute(std::pow(hyab(colors_a[i], colors_b[i]), color_exponent));
        const double feature = std::sqrt( // q_f = 1/2
            std::max(std::abs(features_a.edges[i] - features_b.edges[i]),
                     std::abs(features_a.points[i] - features_b.points[i])) /
            std::numbers::sqrt2);
        error[i] = std::pow(color, 1.0 - feature);
    }
    return error;
}

} // namespace parhelion
