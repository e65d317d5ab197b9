// What two images hold beside the channels that figures are made of.
#include "host/image/other_channels.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace parhelion {

namespace {

bool contains(const std::vector<std::string>& names, const std::string& name) {
    return std::find(names.begin(), names.end(), name) != names.end();
}

/// |a - b|; 0 for the same value, NaN and infinities too.
double difference(float a, float b) {
    if (a == b || (std::isnan(a) && std::isnan(b))) return 0.0;
    if (!std::isfinite(a) || !std::isfinite(b)) return std::numeric_limits<double>::infinity();
    return std::abs(double(a) - double(b));
}

OtherChannel compare_channel(const Channel& image, const Channel& reference, int width) {
    OtherChannel result{image.name, 0, {0.0, image.name, 0, 0}};
    for (std::size_t i = 0; i < image.values.size(); ++i) {
        const double error = difference(image.values[i], reference.values[i]);
        result.different += error > 0.0;
        if (!(error > result.largest.value)) continue;
        const auto columns = static_cast<std::size_t>(width);
        result.largest = {error, image.name, static_cast<int>(i % columns),
                          static_cast<int>(i / columns)};
    }
    return result;
}

} // namespace

bool OtherChannels::all_equal() const {
    return std::all_of(common.begin(), common.end(),
                       [](const OtherChannel& channel) { return channel.different == 0; });
}

double OtherChannels::largest() const {
    double value = 0.0;
    for (const OtherChannel& channel : common)
        value = std::max(value, channel.largest.value);
    return value;
}

OtherChannels compare_other_channels(const Image& image, const Image& reference,
                                     const std::vector<std::string>& compared,
                                     const std::string& layer,
                                     const std::vector<std::string>& left_out_layers) {
    OtherChannels result;
    const auto is_left_out = [&](const std::string& name) {
        return (!layer.empty() && layer_of(name) != layer) ||
               contains(left_out_layers, layer_of(name));
    };
    for (const Channel& channel : image.channels) {
        if (contains(compared, channel.name)) continue;
        const Channel* const other = find_channel(reference, channel.name);
        if (is_left_out(channel.name))
            result.left_out.push_back(channel.name);
        else if (other)
            result.common.push_back(compare_channel(channel, *other, image.width));
        else
            result.in_image.push_back(channel.name);
    }
    for (const Channel& channel : reference.channels) {
        if (find_channel(image, channel.name)) continue;
        (is_left_out(channel.name) ? result.left_out : result.in_reference).push_back(channel.name);
    }
    return result;
}

} // namespace parhelion
