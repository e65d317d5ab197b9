// An image in memory: named float channels, a crop window and metadata; no file format knows more.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace parhelion {

/// One plane of an image. `values` has width * height entries, row-major, top row first.
struct Channel {
    std::string name; ///< "R", or "layer.R" for every layer but the main one
    std::vector<float> values;
};

using MetadataValue = std::variant<std::string, double, std::int64_t>;

/// Pixels (the data window) inside a frame (the display window): a crop has width < full_width.
struct Image {
    int width = 0, height = 0;           ///< pixels stored
    int full_width = 0, full_height = 0; ///< the frame they belong to, pixels
    int offset_x = 0, offset_y = 0;      ///< top left pixel stored, in the frame
    std::vector<Channel> channels;
    std::vector<std::pair<std::string, MetadataValue>> metadata;

    std::size_t index(int x, int y) const {
        return static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
               static_cast<std::size_t>(x);
    }
    std::size_t pixel_count() const { return static_cast<std::size_t>(width) * height; }
};

/// An image without channels that fills its frame.
Image make_image(int width, int height);

/// The channel of this name, or nullptr.
const Channel* find_channel(const Image& image, const std::string& name);

/// Adds a channel. Throws std::invalid_argument for a name that is empty or taken, or a wrong
/// length.
void add_channel(Image& image, const std::string& name, std::vector<float> values);

/// Adds interleaved pixels as one channel a component: components {"R", "G", "B"} of layer "albedo"
/// become albedo.R, albedo.G, albedo.B; the main layer is "". Throws as add_channel does.
void add_layer(Image& image, const std::string& layer, std::span<const std::string> components,
               std::span<const float> interleaved);

/// add_layer with components R, G, B.
void add_rgb_layer(Image& image, const std::string& layer, std::span<const float> interleaved);

/// Layer of a channel name: what stands before its last dot, "" for the main layer.
std::string layer_of(const std::string& channel_name);

} // namespace parhelion
