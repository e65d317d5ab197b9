// How large a wave may be, by how long the launches of those before it took.
#include "host/waves/wave_pace.h"

#include <algorithm>

namespace parhelion {
namespace {

constexpr int first_limit = 256, growth = 4; // 4096 paths
// Between the two nothing changes, so that a device which does other things as well is not followed
// at every turn; above the upper one there is room for blocks that take longer than those before.
constexpr double wanted = 0.6 * longest_launch, too_long = 0.8 * longest_launch;

} // namespace

int first_wave_limit(int most) { return std::min(first_limit, most); }

int next_wave_limit(int limit, int most, int wave, double seconds) {
    // The time of a launch grows with its paths, or more slowly where they do not fill the device.
    const double fitting =
        seconds > 0 ? std::max(1.0, wave * (wanted / seconds)) : double{growth} * wave;
    const int next = static_cast<int>(std::min({fitting, double{growth} * wave, 1.0 * most}));
    return seconds > too_long ? std::min(limit, next) : std::max(limit, next);
}

} // namespace parhelion
