// An image that is made a band of rows at a time, so that no more of it need be in memory.
#include "host/image/image_rows.h"

#include <stdexcept>

namespace parhelion {
namespace {

/// All of an image but its channels.
Image without_channels(const Image& image) {
    Image frame;
    frame.width = image.width, frame.height = image.height;
    frame.full_width = image.full_width, frame.full_height = image.full_height;
    frame.offset_x = image.offset_x, frame.offset_y = image.offset_y;
    return frame;
}

} // namespace

WholeImage::WholeImage(const Image& image) : image_(image), frame_(without_channels(image)) {
    frame_.metadata = image.metadata;
    frame_.channels.reserve(image.channels.size());
    for (const Channel& channel : image.channels) {
        if (channel.values.size() != image.pixel_count())
            throw std::invalid_argument("channel " + channel.name + " has a wrong length");
        frame_.channels.push_back({channel.name, {}});
    }
}

Image WholeImage::rows(int first, int count) const {
    Image band = without_channels(image_);
    band.height = count, band.offset_y += first;
    band.channels.reserve(image_.channels.size());
    for (const Channel& channel : image_.channels) {
        const float* values = channel.values.data() + image_.index(0, first);
        band.channels.push_back({channel.name, {values, values + band.pixel_count()}});
    }
    return band;
}

} // namespace parhelion
