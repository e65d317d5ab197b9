// Images as textures read them: texels of bytes, halves or floats, in any of the formats of one
// list. What an image holds is known before memory is taken for it.
#pragma once

#include <array>
#include <cstddef>
#include <functional>
#include <span>
#include <string>
#include <string_view>

namespace parhelion {

enum class TexelComponent { byte, half, single };
inline constexpr std::array<std::string_view, 3> texel_component_names{"byte", "half", "float"};

/// Texels in rows, the top row first; components of a texel lie side by side (R G B, or one that
/// stands for all three), in the machine's order of bytes.
struct TexelLayout {
    int width = 0, height = 0;
    int channels = 3; ///< 1 or 3; a file's alpha is not read
    TexelComponent component = TexelComponent::byte;
    /// Values are encoded by the sRGB transfer function, if they are colours. Bytes stand for 0 to
    /// 1; so do the 16-bit integers of a file, which come as floats.
    bool srgb = false;

    std::size_t component_bytes() const { return std::size_t{1} << static_cast<int>(component); }
    std::size_t texel_bytes() const {
        return component_bytes() * static_cast<std::size_t>(channels);
    }
    std::size_t texels() const { return static_cast<std::size_t>(width) * height; }
    std::size_t bytes() const { return texels() * texel_bytes(); }
    bool operator==(const TexelLayout&) const = default;
};

/// An image that can be read: from a file, or from wherever whoever made it says.
struct TexelSource {
    std::string name; ///< the file's; the same name stands for the same texels
    TexelLayout layout;
    /// Fills layout.bytes() bytes. Throws InputError for a file that is damaged, incomplete, or no
    /// longer what it was.
    std::function<void(std::span<std::byte>)> read;
};

/// Sides and number of texels that are accepted: 800 MB of bytes, three a texel.
inline constexpr int longest_texel_side = 65536;
inline constexpr std::size_t most_texels = std::size_t{1} << 28;

/// The image in a file. Throws InputError, one line, for a file that cannot be read, is of no known
/// format, broken, or larger than is accepted.
TexelSource open_texels(const std::string& file);

/// The layout and then the texels of a file's bytes at hand, called `name` in messages. They throw
/// as open_texels and its source's `read` do.
TexelLayout layout_of_texels(std::string_view bytes, const std::string& name);
void parse_texels(std::string_view bytes, const std::string& name, const TexelLayout& layout,
                  std::span<std::byte> to);

/// Names of the formats, for messages: "PNG, JPEG, ...".
std::string texel_format_names();

} // namespace parhelion
