// The mean of a texture.
#include "host/flatten/texture_mean.h"

#include "host/flatten/texture_records.h"

#include <half.h>

#include <cstdint>
#include <cstring>
#include <vector>

namespace parhelion {
namespace {

template<class Component, class Decode>
Rgb mean_of(std::span<const std::byte> texels, int channels, const Decode& decode) {
    const std::size_t texel = sizeof(Component) * static_cast<std::size_t>(channels);
    Rgb sum(0.0);
    for (std::size_t at = 0; at + texel <= texels.size(); at += texel)
        for (int c = 0; c < 3; c++) {
            Component component;
            std::size_t channel = channels == 1 ? 0 : static_cast<std::size_t>(c);
            std::memcpy(&component, texels.data() + at + channel * sizeof(Component),
                        sizeof(Component));
            sum[c] += decode(component);
        }
    return sum * (static_cast<double>(texel) / static_cast<double>(texels.size()));
}

Rgb mean_of(const BitmapTexture& bitmap, std::span<const std::byte> texels) {
    const TexelLayout& layout = bitmap.source.layout;
    switch (layout.component) {
    case TexelComponent::byte: {
        const bool linear = bitmap.raw || !layout.srgb;
        const std::vector<float> values = make_byte_values();
        const int first = linear ? BYTE_VALUES / 2 : 0;
        return mean_of<std::uint8_t>(texels, layout.channels, [&](std::uint8_t byte) {
            return double{values[first + byte]};
        });
    }
    case TexelComponent::half:
        return mean_of<Imath::half>(texels, layout.channels,
                                    [](Imath::half v) { return double{static_cast<float>(v)}; });
    case TexelComponent::single:
        return mean_of<float>(texels, layout.channels, [](float v) { return double{v}; });
    }
    return Rgb(0.0);
}

Rgb mean_of(const CheckerboardTexture& board, std::span<const std::byte>) {
    return 0.5 * (board.color0 + board.color1);
}

Rgb mean_of(const MeshAttributeTexture&, std::span<const std::byte>) { return Rgb(1.0); }

} // namespace

Rgb texture_mean(const Texture& texture, std::span<const std::byte> texels) {
    return std::visit([&](const auto& kind) { return mean_of(kind, texels); }, texture.kind);
}

} // namespace parhelion
