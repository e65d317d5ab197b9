// Between which values a texture stays.
#include "host/flatten/texture_bounds.h"

#include <half.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

namespace parhelion {
namespace {

template<class Component>
ValueBounds bounds_of(std::span<const std::byte> texels) {
    float lowest = std::numeric_limits<float>::infinity(), highest = -lowest;
    for (std::size_t at = 0; at < texels.size(); at += sizeof(Component)) {
        Component component;
        std::memcpy(&component, texels.data() + at, sizeof(Component));
        const float value = component;
        if (!std::isfinite(value)) return {value, value};
        lowest = std::min(lowest, value), highest = std::max(highest, value);
    }
    return {lowest, highest};
}

ValueBounds bounds_of(const BitmapTexture& bitmap, std::span<const std::byte> texels) {
    switch (bitmap.source.layout.component) {
    case TexelComponent::byte:
        return {0.0, 1.0};
    case TexelComponent::half:
        return bounds_of<Imath::half>(texels);
    case TexelComponent::single:
        return bounds_of<float>(texels);
    }
    return {0.0, 0.0};
}

ValueBounds bounds_of(const CheckerboardTexture& board, std::span<const std::byte>) {
    const Rgb &a = board.color0, &b = board.color1;
    return {std::min({a.r, a.g, a.b, b.r, b.g, b.b}), std::max({a.r, a.g, a.b, b.r, b.g, b.b})};
}

/// What a mesh has is looked at where it is known.
ValueBounds bounds_of(const MeshAttributeTexture&, std::span<const std::byte>) {
    return {0.0, 0.0};
}

} // namespace

ValueBounds bounds_of_values(std::span<const float> values) {
    return values.empty() ? ValueBounds{0.0, 0.0} : bounds_of<float>(std::as_bytes(values));
}

ValueBounds texture_bounds(const Texture& texture, std::span<const std::byte> texels) {
    return std::visit([&](const auto& kind) { return bounds_of(kind, texels); }, texture.kind);
}

} // namespace parhelion
