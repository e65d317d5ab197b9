// Textures, and parameters that are a constant or a texture.
#pragma once

#include "host/domain.h"
#include "host/error.h"
#include "host/image/texels.h"
#include "kernels/shared/features.h"

#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>

#include <concepts>
#include <memory>
#include <string>
#include <utility>
#include <variant>

namespace parhelion {

using Rgb =
    glm::dvec3; ///< linear sRGB primaries, D65 white; radiometric unit given where it is used

enum class TextureFilter { bilinear, nearest };
/// What stands beyond an image: it again, its mirror image, its border.
enum class TextureWrap { repeat, mirror, clamp };

/// An image; (0, 0) is the top left corner of its first row, (1, 1) the bottom right one of its
/// last, texels have their values at their centres.
struct BitmapTexture {
    TexelSource source;
    TextureFilter filter = TextureFilter::bilinear;
    TextureWrap wrap = TextureWrap::repeat;
    bool raw = false; ///< its values are no colours in sRGB, whatever the file says

    bool operator==(const BitmapTexture& other) const {
        return source.name == other.source.name && source.layout == other.source.layout &&
               filter == other.filter && wrap == other.wrap && raw == other.raw;
    }
};

/// Squares of side 1/2, the one from (0, 0) on of color0.
struct CheckerboardTexture {
    Rgb color0{0.4}, color1{0.2};

    bool operator==(const CheckerboardTexture&) const = default;
};

/// What a mesh has at its vertices, interpolated, or of its faces.
struct MeshAttributeTexture {
    std::string name; ///< begins with "vertex_" or "face_"
    double scale = 1.0;

    bool of_faces() const { return name.starts_with("face_"); }
    bool operator==(const MeshAttributeTexture&) const = default;
};

template<class, class... Kinds>
struct TextureKinds {
    using Type = std::variant<Kinds...>;
};
#define TEXTURE_TYPE(name, Name) , Name##Texture

struct Texture {
    std::string id;        ///< the author's, or empty
    glm::dmat3 to_uv{1.0}; ///< applied to (u, v, 1) of the surface first
    TextureKinds<void TEXTURES(TEXTURE_TYPE)>::Type kind; ///< its index is the TextureKind

    /// The same but for its name.
    bool operator==(const Texture& other) const {
        return to_uv == other.to_uv && kind == other.kind;
    }
};

/// A texture in place of a constant.
struct TextureUse {
    std::shared_ptr<const Texture> texture; ///< null: there is none
    // For messages about values that the parameter cannot take.
    SourceLocation location;
    std::string parameter; ///< bsdf plugin "diffuse": parameter "reflectance"
    Domain domain;         ///< of the parameter's values

    explicit operator bool() const { return texture != nullptr; }
};

/// A parameter that is the same everywhere, or told by a texture. The constant of one with a
/// texture means nothing.
template<class T>
struct Textured {
    T constant{};
    TextureUse texture{};

    Textured() = default;
    // NOLINTBEGIN(google-explicit-constructor): constants stand for themselves
    Textured(const T& value) : constant(value) {}
    Textured(double value) requires(!std::same_as<T, double>) : constant(value) {}
    // NOLINTEND(google-explicit-constructor)
    explicit Textured(TextureUse use) : texture(std::move(use)) {}

    /// The same constant, or textures that are the same.
    friend bool operator==(const Textured& a, const Textured& b) {
        if (!a.texture || !b.texture) return !a.texture && !b.texture && a.constant == b.constant;
        return *a.texture.texture == *b.texture.texture;
    }
};

} // namespace parhelion
