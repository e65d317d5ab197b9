// What of an image a file does not hold as it is.
#include "host/image/misfits.h"

namespace parhelion {

void Misfits::add(int at_x, int at_y, float v, bool finite) {
    if (count() == 0) x = at_x, y = at_y, value = v;
    (finite ? out_of_range : not_finite)++;
}

std::uint64_t misfit_count(const std::vector<Misfits>& channels) {
    std::uint64_t count = 0;
    for (const Misfits& channel : channels)
        count += channel.count();
    return count;
}

} // namespace parhelion
