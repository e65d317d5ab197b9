// The middle of repeated measurements.
#pragma once

#include <algorithm>
#include <vector>

namespace parhelion::bench {

/// Of at least one value; the lower of the two middle ones where there are two.
inline double median(std::vector<double> values) {
    auto middle = values.begin() + static_cast<std::ptrdiff_t>((values.size() - 1) / 2);
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
}

/// The middle of a[i] / b[i].
inline double median_ratio(const std::vector<double>& a, const std::vector<double>& b) {
    std::vector<double> ratios;
    for (std::size_t i = 0; i < a.size(); i++)
        ratios.push_back(a[i] / b[i]);
    return median(ratios);
}

} // namespace parhelion::bench
