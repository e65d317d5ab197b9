// A sky of an image made in memory.
#pragma once

#include "tests/support/example_textures.h"

#include "host/scene/scene.h"

namespace parhelion::test {

inline EnvmapEmitter sky_of(TexelSource image, const Rgb& radiance = Rgb(1),
                            const glm::dmat3& to_world = glm::dmat3(1)) {
    EnvmapEmitter sky;
    sky.image = textured(std::move(image), TextureFilter::bilinear, TextureWrap::repeat).texture;
    sky.to_world = to_world;
    sky.radiance = radiance;
    return sky;
}

/// Of 8 columns and 5 rows, uneven and partly black, but 1 about +z.
inline TexelSource example_sky_texels() {
    constexpr int width = 8, rows = 5;
    std::vector<float> values;
    values.reserve(3 * width * rows);
    for (int y = 0; y < rows; y++)
        for (int x = 0; x < width; x++)
            for (int c = 0; c < 3; c++) {
                bool middle = (x == 3 || x == 4) && y > 0 && y < rows - 1;
                bool black = x == 6 || (x == 7 && y == 2);
                int n = 3 * (y * width + x) + c;
                float uneven = black ? 0.f : 0.25f * static_cast<float>(n * 7 % 11);
                values.push_back(middle ? 1.f : uneven);
            }
    return texels_of(width, rows, 3, TexelComponent::half, values);
}

/// In the place of a constant sky, as bright where it is 1.
inline void put_example_sky(Scene& scene) {
    for (Emitter& e : scene.emitters)
        if (const auto* constant = std::get_if<ConstantEmitter>(&e))
            e = sky_of(example_sky_texels(), constant->radiance);
}

} // namespace parhelion::test
