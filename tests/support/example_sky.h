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

/// In the place of the sky that there is, as bright as that says, with the light of its own; none
/// at first. Up lies where the camera of the panel never looks.
inline SunskyEmitter& put_example_daylight(Scene& scene) {
    SunskyEmitter daylight;
    daylight.turbidity = 2.5, daylight.albedo = Rgb(0.4, 0.3, 0.2);
    daylight.to_world = {glm::dvec3(0, 1, 0), glm::dvec3(0, 0, -1), glm::dvec3(-1, 0, 0)};
    daylight.sun = {0.48, 0.6, -0.64};
    daylight.half_aperture = 0.05;
    daylight.sun_scale = daylight.sky_scale = 0;
    Emitter* place = nullptr;
    for (Emitter& e : scene.emitters)
        if (is_sky(e)) place = &e;
    if (!place) place = &scene.emitters.emplace_back(ConstantEmitter{});
    if (auto* there = std::get_if<SunskyEmitter>(place)) return *there;
    if (const auto* constant = std::get_if<ConstantEmitter>(place))
        daylight.radiance = constant->radiance;
    if (const auto* image = std::get_if<EnvmapEmitter>(place)) daylight.radiance = image->radiance;
    *place = daylight;
    return std::get<SunskyEmitter>(*place);
}

} // namespace parhelion::test
