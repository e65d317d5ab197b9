// The mean of a texture, and the highest of its components.
#include "host/flatten/texture_mean.h"

#include "host/flatten/texture_records.h"

#include <half.h>

#include <glm/common.hpp>

#include <cstdint>
#include <cstring>
#include <vector>

namespace parhelion {
namespace {

/// visit(colour) for each texel; grey ones in all components.
template<class Component, class Decode, class Visit>
void each_texel(std::span<const std::byte> texels, int channels, const Decode& decode,
                const Visit& visit) {
    const std::size_t texel = sizeof(Component) * static_cast<std::size_t>(channels);
    for (std::size_t at = 0; at + texel <= texels.size(); at += texel) {
        Rgb color;
        for (int c = 0; c < 3; c++) {
            Component component;
            std::size_t channel = channels == 1 ? 0 : static_cast<std::size_t>(c);
            std::memcpy(&component, texels.data() + at + channel * sizeof(Component),
                        sizeof(Component));
            color[c] = decode(component);
        }
        visit(color);
    }
}

template<class Visit>
void each_texel(const BitmapTexture& bitmap, std::span<const std::byte> texels,
                const Visit& visit) {
    const TexelLayout& layout = bitmap.source.layout;
    switch (layout.component) {
    case TexelComponent::byte: {
        const bool linear = bitmap.raw || !layout.srgb;
        const std::vector<float> values = make_byte_values();
        const int first = linear ? BYTE_VALUES / 2 : 0;
        return each_texel<std::uint8_t>(
            texels, layout.channels,
            [&](std::uint8_t byte) { return double{values[first + byte]}; }, visit);
    }
    case TexelComponent::half:
        return each_texel<Imath::half>(
            texels, layout.channels, [](Imath::half v) { return double{static_cast<float>(v)}; },
            visit);
    case TexelComponent::single:
        return each_texel<float>(
            texels, layout.channels, [](float v) { return double{v}; }, visit);
    }
}

Rgb mean_of(const BitmapTexture& bitmap, std::span<const std::byte> texels) {
    Rgb sum(0.0);
    double count = 0.0;
    each_texel(bitmap, texels, [&](const Rgb& color) { sum += color, count += 1.0; });
    return sum * (1.0 / count);
}

Rgb highest_of(const BitmapTexture& bitmap, std::span<const std::byte> texels) {
    Rgb highest(0.0);
    each_texel(bitmap, texels, [&](const Rgb& color) { highest = glm::max(highest, color); });
    return highest;
}

Rgb highest_of(const CheckerboardTexture& board, std::span<const std::byte>) {
    return glm::max(board.color0, board.color1);
}

Rgb highest_of(const MeshAttributeTexture&, std::span<const std::byte>) { return Rgb(1.0); }

Rgb mean_of(const CheckerboardTexture& board, std::span<const std::byte>) {
    return 0.5 * (board.color0 + board.color1);
}

Rgb mean_of(const MeshAttributeTexture&, std::span<const std::byte>) { return Rgb(1.0); }

} // namespace

Rgb texture_mean(const Texture& texture, std::span<const std::byte> texels) {
    return std::visit([&](const auto& kind) { return mean_of(kind, texels); }, texture.kind);
}

Rgb texture_highest(const Texture& texture, std::span<const std::byte> texels) {
    return std::visit([&](const auto& kind) { return highest_of(kind, texels); }, texture.kind);
}

} // namespace parhelion
