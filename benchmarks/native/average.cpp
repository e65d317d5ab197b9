// Averaging images: a reference made of several renders.
#include "benchmarks/native/average.h"

#include "host/error.h"
#include "host/image/exr.h"

#include <fmt/format.h>

#include <algorithm>

namespace parhelion::bench {

void average_images(const std::vector<WeightedImage>& images, const std::string& output) {
    if (images.empty()) throw InputError("no images to average");
    Image mean = read_exr(images.front().file);
    double whole = 0;
    std::vector<std::vector<double>> sums;
    for (const Channel& c : mean.channels)
        sums.emplace_back(c.values.size(), 0.0);
    for (const WeightedImage& w : images) {
        Image image = read_exr(w.file);
        whole += w.weight;
        for (std::size_t k = 0; k < sums.size(); k++) {
            const Channel* channel = find_channel(image, mean.channels[k].name);
            if (!channel || channel->values.size() != sums[k].size())
                throw InputError(fmt::format("{} and {} have other channels or sizes", w.file,
                                             images.front().file));
            for (std::size_t i = 0; i < sums[k].size(); i++)
                sums[k][i] += w.weight * channel->values[i];
        }
    }
    for (std::size_t k = 0; k < sums.size(); k++)
        std::transform(sums[k].begin(), sums[k].end(), mean.channels[k].values.begin(),
                       [&](double sum) { return static_cast<float>(sum / whole); });
    mean.metadata.clear(); // of one of them
    if (!write_exr(output, mean).empty())
        throw InputError(output + ": values too large for an image");
}

} // namespace parhelion::bench
