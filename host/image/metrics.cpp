// RMSE, relMSE, MAE, bias and the largest error of image pairs.
#include "host/image/metrics.h"

#include <cmath>
#include <limits>
#include <stdexcept>

namespace parhelion {

namespace {

bool same(float a, float b) { return a == b || (std::isnan(a) && std::isnan(b)); }

bool comparable(float a, float b) { return std::isfinite(a) && std::isfinite(b); }

/// Sums over the values of one channel.
struct Sums {
    double squared = 0.0, relative = 0.0, absolute = 0.0, image = 0.0, reference = 0.0;
    std::size_t count = 0;

    void add(double value, double truth, double epsilon) {
        const double difference = value - truth;
        squared += difference * difference;
        // 0/0 where epsilon is 0 and both are 0: there is no error there.
        if (difference != 0.0) relative += difference * difference / (truth * truth + epsilon);
        absolute += std::abs(difference);
        image += value;
        reference += truth;
        ++count;
    }

    void add(const Sums& other) {
        squared += other.squared;
        relative += other.relative;
        absolute += other.absolute;
        image += other.image;
        reference += other.reference;
        count += other.count;
    }

    ErrorFigures figures() const {
        if (count == 0) throw std::invalid_argument("no finite values to compare");
        const double n = static_cast<double>(count);
        return {std::sqrt(squared / n), relative / n, absolute / n, image / n, reference / n};
    }
};

void update_largest(LargestError& largest, double error, const std::string& channel,
                    std::size_t index, int width) {
    if (!(error > largest.value) && !largest.channel.empty()) return;
    const auto columns = static_cast<std::size_t>(width);
    largest = {error, channel, static_cast<int>(index % columns),
               static_cast<int>(index / columns)};
}

} // namespace

double ErrorFigures::relative_bias() const {
    if (bias() == 0.0) return 0.0;
    return bias() / std::abs(mean_reference); // infinite where the reference is black
}

NonFinite count_non_finite(const std::vector<ChannelPair>& pairs, int width) {
    NonFinite counts;
    for (const ChannelPair& pair : pairs) {
        for (std::size_t i = 0; i < pair.image.size(); ++i) {
            const float value = pair.image[i], truth = pair.reference[i];
            if (comparable(value, truth)) continue;
            counts.in_image += !std::isfinite(value);
            counts.in_reference += !std::isfinite(truth);
            if (same(value, truth)) {
                ++counts.equal;
            } else {
                if (counts.different == 0)
                    update_largest(counts.first_different, 0.0, pair.name, i, width);
                ++counts.different;
            }
        }
    }
    return counts;
}

Metrics compute_metrics(const std::vector<ChannelPair>& pairs, int width, double epsilon) {
    Metrics metrics;
    metrics.epsilon = epsilon;
    Sums all;
    for (const ChannelPair& pair : pairs) {
        if (pair.image.size() != pair.reference.size())
            throw std::invalid_argument("channels of different lengths");
        Sums sums;
        for (std::size_t i = 0; i < pair.image.size(); ++i) {
            const float value = pair.image[i], truth = pair.reference[i];
            if (!comparable(value, truth)) {
                if (same(value, truth)) continue;
                throw std::invalid_argument("values that are not finite differ");
            }
            sums.add(value, truth, epsilon);
            update_largest(metrics.largest, std::abs(double(value) - double(truth)), pair.name, i,
                           width);
        }
        metrics.channels.push_back(sums.figures());
        all.add(sums);
    }
    metrics.all = all.figures();
    return metrics;
}

} // namespace parhelion
