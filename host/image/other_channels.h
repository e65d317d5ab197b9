// What two images hold beside the channels that figures are made of.
#pragma once

#include "host/image/metrics.h"

#include <string>
#include <vector>

namespace parhelion {

/// A channel that both images have and no figure is of.
struct OtherChannel {
    std::string name;
    std::size_t different = 0; ///< values that are not the same (NaN equals NaN)
    LargestError largest;      ///< infinite where a value is not finite in one image alone
};

struct OtherChannels {
    std::vector<OtherChannel> common;
    std::vector<std::string> in_image, in_reference; ///< channels that one of them alone has
    std::vector<std::string> left_out;               ///< not looked at

    bool none_missing() const { return in_image.empty() && in_reference.empty(); }
    bool all_equal() const;
    /// Of all values; 0 where there are none.
    double largest() const;
};

/// Compares what is in neither `compared` (names of channels) nor `left_out_layers`; where `layer`
/// is not empty, all other layers are left out, too. The images are of one size.
OtherChannels compare_other_channels(const Image& image, const Image& reference,
                                     const std::vector<std::string>& compared,
                                     const std::string& layer,
                                     const std::vector<std::string>& left_out_layers);

} // namespace parhelion
