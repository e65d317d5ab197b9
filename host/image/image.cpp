// Adding, finding and naming the channels of an Image.
#include "host/image/image.h"

#include <array>
#include <stdexcept>

namespace parhelion {

Image make_image(int width, int height) {
    if (width < 1 || height < 1) throw std::invalid_argument("an image needs at least one pixel");
    Image image;
    image.width = image.full_width = width;
    image.height = image.full_height = height;
    return image;
}

const Channel* find_channel(const Image& image, const std::string& name) {
    for (const Channel& channel : image.channels)
        if (channel.name == name) return &channel;
    return nullptr;
}

void add_channel(Image& image, const std::string& name, std::vector<float> values) {
    if (name.empty()) throw std::invalid_argument("a channel needs a name");
    if (find_channel(image, name)) throw std::invalid_argument("channel " + name + " exists");
    if (values.size() != image.pixel_count())
        throw std::invalid_argument("channel " + name + " has " + std::to_string(values.size()) +
                                    " values, expected " + std::to_string(image.pixel_count()));
    image.channels.push_back({name, std::move(values)});
}

void add_layer(Image& image, const std::string& layer, std::span<const std::string> components,
               std::span<const float> interleaved) {
    const std::size_t stride = components.size();
    if (interleaved.size() != image.pixel_count() * stride)
        throw std::invalid_argument("layer '" + layer + "' has " +
                                    std::to_string(interleaved.size()) + " values, expected " +
                                    std::to_string(image.pixel_count() * stride));
    for (std::size_t c = 0; c < stride; ++c) {
        std::vector<float> values(image.pixel_count());
        for (std::size_t i = 0; i < values.size(); ++i)
            values[i] = interleaved[i * stride + c];
        const std::string& component = components[c];
        add_channel(image, layer.empty() ? component : layer + "." + component, std::move(values));
    }
}

void add_rgb_layer(Image& image, const std::string& layer, std::span<const float> interleaved) {
    const std::array<std::string, 3> components{"R", "G", "B"};
    add_layer(image, layer, components, interleaved);
}

std::string layer_of(const std::string& channel_name) {
    const std::size_t dot = channel_name.rfind('.');
    return dot == std::string::npos ? std::string() : channel_name.substr(0, dot);
}

} // namespace parhelion
