// Skies of images and what is known of them, in double, from the definition of their layout alone.
#pragma once

#include "host/numerics/measure.h"
#include "host/scene/scene.h"

#include <cmath>
#include <cstddef>
#include <cstring>
#include <memory>
#include <numbers>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace parhelion::numerics {

/// Grey texels, the row at +y first.
struct SkyImage {
    std::string name;
    int width, rows;
    std::vector<float> values;

    double at(int x, int y) const {
        return values[static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
                      static_cast<std::size_t>((x + width) % width)];
    }
    /// Radiance at `turn` (0 to 1, from -z over +x) and `fall` (0 to 1, from +y to -y).
    double radiance_at(double turn, double fall) const {
        double x = turn * width - 0.5, y = fall * (rows - 1);
        int column = static_cast<int>(std::floor(x)),
            row = std::min(static_cast<int>(std::floor(y)), rows - 2);
        double s = x - column, t = y - row;
        double upper = (1 - s) * at(column, row) + s * at(column + 1, row);
        double lower = (1 - s) * at(column, row + 1) + s * at(column + 1, row + 1);
        return (1 - t) * upper + t * lower;
    }
    static std::pair<double, double> turn_and_fall(f64::vec3 w) {
        double turn = std::atan2(w.x, -w.z) / (2 * std::numbers::pi);
        double fall = std::atan2(std::hypot(w.x, w.z), w.y) / std::numbers::pi;
        return {turn - std::floor(turn), fall};
    }
    double radiance(f64::vec3 w) const {
        auto [turn, fall] = turn_and_fall(w);
        return radiance_at(turn, fall);
    }
    /// Its integral over a cell of directions between four texels, by the midpoint rule.
    double cell_integral(int column, int row, int steps) const {
        double sum = 0, height = std::numbers::pi / (rows - 1);
        for (int j = 0; j < steps; j++) {
            double fall = (row + (j + 0.5) / steps) / (rows - 1);
            for (int i = 0; i < steps; i++)
                sum += radiance_at((column + 0.5 + (i + 0.5) / steps) / width, fall) *
                       std::sin(std::numbers::pi * fall);
        }
        return sum * height * 2 * std::numbers::pi / width / (double(steps) * steps);
    }
};

inline SkyImage sky_image(std::string name, int width, int rows, double (*value)(int x, int y)) {
    SkyImage image{std::move(name), width, rows, {}};
    image.values.reserve(static_cast<std::size_t>(width) * static_cast<std::size_t>(rows));
    for (int y = 0; y < rows; y++)
        for (int x = 0; x < width; x++)
            image.values.push_back(static_cast<float>(value(x, y)));
    return image;
}

inline double uneven_texel(int x, int y) { return 0.1 + (x * 7 + y * 5) % 11; }
inline double even_texel(int, int) { return 0.75; }
/// A sun of one texel, 1e5 as bright as the sky, black about it.
inline double sunny_texel(int x, int y) {
    if (x == 11 && y == 5) return 1e5;
    return std::abs(x - 11) < 3 && std::abs(y - 5) < 3 ? 0 : 1 + 0.1 * ((x + y) % 3);
}
/// Nothing but the row of a pole, and one texel of the other.
inline double polar_texel(int x, int y) { return y == 0 ? 2 : y == 8 && x == 1 ? 5 : 0; }

inline std::vector<SkyImage> sky_images() {
    return {sky_image("uneven, one column", 1, 3, uneven_texel),
            sky_image("uneven, two rows", 3, 2, uneven_texel),
            sky_image("uneven, odd rows of cells", 5, 4, uneven_texel),
            sky_image("uneven, even rows of cells", 16, 9, uneven_texel),
            sky_image("even", 7, 6, even_texel),
            sky_image("a small sun", 64, 33, sunny_texel),
            sky_image("bright poles", 6, 9, polar_texel)};
}

/// Its emitter; `radiance` of a texel of 1.
inline EnvmapEmitter envmap_of(const SkyImage& image, const Rgb& radiance = Rgb(1.0),
                               const glm::dmat3& to_world = glm::dmat3(1.0)) {
    BitmapTexture bitmap;
    bitmap.source.name = image.name;
    bitmap.source.layout = {image.width, image.rows, 1, TexelComponent::single, false};
    bitmap.source.read = [values = image.values](std::span<std::byte> to) {
        std::memcpy(to.data(), values.data(), to.size());
    };
    EnvmapEmitter emitter;
    emitter.image = {std::make_shared<const Texture>(Texture{"", glm::dmat3(1.0), bitmap}),
                     {},
                     "a sky",
                     between(0, 3.4e38)};
    emitter.radiance = radiance;
    emitter.to_world = to_world;
    return emitter;
}

} // namespace parhelion::numerics
