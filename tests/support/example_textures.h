// Textures made in memory, and materials that use them.
#pragma once

#include "host/scene/material.h"

#include <half.h>

#include <array>
#include <cstdint>
#include <cstring>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace parhelion::test {

/// An image of floats, as many as its texels have components; bytes of 0 to 255, halves of IEEE
/// 754.
inline TexelSource texels_of(int width, int height, int channels, TexelComponent component,
                             const std::vector<float>& values, bool srgb = false) {
    // The same name stands for the same texels.
    std::string name = "made by the test: " + std::to_string(static_cast<int>(component));
    for (float value : values)
        name += " " + std::to_string(value);
    TexelLayout layout{width, height, channels, component, srgb};
    return {name, layout, [=](std::span<std::byte> to) {
                for (std::size_t k = 0; k < values.size(); k++) {
                    bool bytes = component == TexelComponent::byte;
                    auto byte = static_cast<std::uint8_t>(bytes ? values[k] : 0.f);
                    std::uint16_t half = Imath::half(values[k]).bits();
                    const void* from = bytes ? static_cast<void*>(&byte)
                                       : component == TexelComponent::half
                                           ? static_cast<void*>(&half)
                                           : nullptr;
                    std::memcpy(&to[k * layout.component_bytes()], from ? from : &values[k],
                                layout.component_bytes());
                }
            }};
}

inline Textured<Rgb> textured(Texture texture, Domain domain = any_number()) {
    return Textured<Rgb>(TextureUse{std::make_shared<const Texture>(std::move(texture)),
                                    {},
                                    "a parameter of the test",
                                    domain});
}
inline Textured<Rgb> textured(TexelSource source, TextureFilter filter = TextureFilter::bilinear,
                              TextureWrap wrap = TextureWrap::repeat, bool raw = false) {
    return textured(
        Texture{"", glm::dmat3(1), BitmapTexture{std::move(source), filter, wrap, raw}});
}
inline Textured<double> as_number(const Textured<Rgb>& color) {
    return Textured<double>(color.texture);
}

/// Two rows of three texels, no two values alike, all between 0.1 and 0.9.
inline TexelSource example_texels(TexelComponent component) {
    std::vector<float> values;
    values.reserve(18);
    for (int k = 0; k < 18; k++)
        values.push_back(component == TexelComponent::byte
                             ? static_cast<float>(30 + 11 * k)
                             : 0.125f + 0.04f * static_cast<float>(k));
    return texels_of(3, 2, 3, component, values, component == TexelComponent::byte);
}

inline Textured<Rgb> example_bitmap() { return textured(example_texels(TexelComponent::byte)); }
inline Textured<Rgb> example_checkerboard() {
    glm::dmat3 to_uv(3, 0.5, 0, -1, 2, 0, 0.1, 0.2, 1);
    return textured(
        Texture{"", to_uv, CheckerboardTexture{Rgb(0.2, 0.3, 0.6), Rgb(0.7, 0.5, 0.4)}});
}
using ExampleTexture = Textured<Rgb> (*)();
/// One of each kind that any shape can have: attributes are those of meshes.
inline constexpr std::array<ExampleTexture, texture_kind_count - 1> example_textures{
    example_bitmap, example_checkerboard};

} // namespace parhelion::test
