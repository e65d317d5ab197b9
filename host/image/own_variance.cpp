// Variances from an image's own layers.
#include "host/image/own_variance.h"

#include "host/error.h"

#include <algorithm>
#include <array>
#include <string>

namespace parhelion {
namespace {

const std::array<std::string, 3> colors{"R", "G", "B"};

/// Of images that have the layers.
const std::vector<float>& samples_of(const Image& image) {
    return find_channel(image, "samples.N")->values;
}

void check_samples(const NamedImage& image) {
    if (!has_own_variance(image.image))
        throw InputError(image.name + ": has no variance of its own (layers variance and samples, "
                                      "of `parhelion render --aov variance,samples`)");
    const std::vector<float>& samples = samples_of(image.image);
    if (!std::all_of(samples.begin(), samples.end(), [](float n) { return n >= 2.f; }))
        throw InputError(image.name + ": a pixel has fewer than 2 samples, so no variance");
}

void add_variance_of_mean(const NamedImage& image, const std::string& color,
                          std::vector<float>& sum) {
    const std::vector<float>& samples = samples_of(image.image);
    const std::vector<float>& variance = find_channel(image.image, "variance." + color)->values;
    for (std::size_t i = 0; i < sum.size(); ++i)
        sum[i] += variance[i] / samples[i];
}

} // namespace

bool has_own_variance(const Image& image) {
    return find_channel(image, "samples.N") &&
           std::all_of(colors.begin(), colors.end(), [&](const std::string& color) {
               return find_channel(image, "variance." + color);
           });
}

Image variance_of_difference(const NamedImage& image, const NamedImage& reference) {
    check_windows(image, reference);
    check_samples(image);
    const bool both = has_own_variance(reference.image);
    if (both) check_samples(reference);
    Image result = image.image;
    result.channels.clear();
    for (const std::string& color : colors) {
        std::vector<float> sum(image.image.pixel_count());
        add_variance_of_mean(image, color, sum);
        if (both) add_variance_of_mean(reference, color, sum);
        add_channel(result, color, std::move(sum));
    }
    return result;
}

ZTestOptions own_variance_test(ZTestOptions options, const Image& image) {
    const std::vector<float>& samples = samples_of(image);
    options.samples = 1.0;
    options.reference_samples.reset();
    options.variance_floor /= *std::max_element(samples.begin(), samples.end());
    return options;
}

} // namespace parhelion
