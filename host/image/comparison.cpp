// Choosing what to compare, refusing what cannot be, and collecting the figures.
#include "host/image/comparison.h"

#include "host/error.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace parhelion {

namespace {

const std::array<std::string, 4> color_channels{"R", "G", "B", "A"};

std::string window_text(const Image& image) {
    return std::to_string(image.width) + "x" + std::to_string(image.height) + " pixels at " +
           std::to_string(image.offset_x) + "," + std::to_string(image.offset_y);
}

std::string channel_names(const Image& image) {
    std::string names;
    for (const Channel& channel : image.channels)
        names += (names.empty() ? "" : " ") + channel.name;
    return names;
}

void check_finite(const NamedImage& a, const NamedImage& b, const NonFinite& counts) {
    if (counts.different == 0) return;
    const LargestError& first = counts.first_different;
    throw InputError(a.name + " has " + std::to_string(counts.in_image) + " and " + b.name +
                     " has " + std::to_string(counts.in_reference) +
                     " values that are not finite, " + std::to_string(counts.different) +
                     " of them not the same in both (first at " + std::to_string(first.x) + "," +
                     std::to_string(first.y) + " in " + first.channel + ")");
}

bool all_equal(const std::vector<ChannelPair>& pairs) {
    const auto equal = [](float a, float b) { return a == b || (std::isnan(a) && std::isnan(b)); };
    return std::all_of(pairs.begin(), pairs.end(), [&](const ChannelPair& pair) {
        return std::equal(pair.image.begin(), pair.image.end(), pair.reference.begin(), equal);
    });
}

std::optional<FlipFigures> flip_figures(const std::vector<ChannelPair>& pairs,
                                        const NonFinite& non_finite, const std::string& layer,
                                        int width, int height, double pixels_per_degree) {
    if (non_finite.equal > 0) return std::nullopt;
    LinearRgb image, reference;
    int found = 0;
    const std::string prefix = layer.empty() ? "" : layer + ".";
    for (const ChannelPair& pair : pairs) {
        const auto take = [&](const char* name, auto plane) {
            if (pair.name != prefix + name) return;
            image.*plane = pair.image;
            reference.*plane = pair.reference;
            ++found;
        };
        take("R", &LinearRgb::r);
        take("G", &LinearRgb::g);
        take("B", &LinearRgb::b);
    }
    if (found != 3) return std::nullopt;
    std::vector<double> error = flip_error(image, reference, width, height, pixels_per_degree);
    double sum = 0.0;
    for (const double value : error)
        sum += value;
    const double largest = *std::max_element(error.begin(), error.end());
    return FlipFigures{sum / static_cast<double>(error.size()), largest, std::move(error)};
}

bool is_alpha(const std::string& name) { return name == "A" || name.ends_with(".A"); }

/// The compared channels but alpha, with their variances.
std::vector<TestedChannel> tested_channels(const std::vector<ChannelPair>& pairs,
                                           const NamedImage& variance) {
    std::vector<TestedChannel> tested;
    for (const ChannelPair& pair : pairs) {
        if (is_alpha(pair.name)) continue;
        const Channel* channel = find_channel(variance.image, pair.name);
        if (!channel)
            throw InputError(variance.name + ": no channel " + pair.name + " (it has " +
                             channel_names(variance.image) + ")");
        for (const float value : channel->values)
            if (!std::isfinite(value))
                throw InputError(variance.name + ": a variance in " + pair.name + " is not finite");
        tested.push_back({pair.name,
                          {pair.image.begin(), pair.image.end()},
                          {pair.reference.begin(), pair.reference.end()},
                          {channel->values.begin(), channel->values.end()}});
    }
    return tested;
}

void add_z_test(Comparison& comparison, const std::vector<ChannelPair>& pairs,
                const NamedImage& reference, const VarianceInput& input) {
    const NamedImage& variance = input.image;
    check_windows(reference, variance);
    if (comparison.non_finite.equal > 0)
        throw InputError(reference.name + ": a z-test needs finite values");
    std::vector<TestedChannel> tested = tested_channels(pairs, variance);
    if (tested.empty()) throw InputError(reference.name + ": no channel but alpha to z-test");
    if (input.xyz_statistics) {
        for (std::size_t c = 0; c < 3; ++c)
            if (tested.size() != 3 || tested[c].name != color_channels[c])
                throw InputError(reference.name +
                                 ": XYZ statistics need the channels R, G and B in every file");
        undo_xyz_statistics(tested);
    }
    for (const TestedChannel& channel : tested) {
        double sum = 0.0;
        for (const double value : channel.variance) {
            comparison.negative_variances += value < 0.0;
            sum += value;
        }
        if (sum < 0.0)
            throw InputError(variance.name + ": the variance of " + channel.name +
                             " is negative (--xyz-statistics is for Mitsuba's references)");
    }
    comparison.z_test = run_z_test(tested, comparison.width, input.test);
}

} // namespace

void check_windows(const NamedImage& a, const NamedImage& b) {
    if (a.image.width != b.image.width || a.image.height != b.image.height ||
        a.image.offset_x != b.image.offset_x || a.image.offset_y != b.image.offset_y)
        throw InputError(a.name + " has " + window_text(a.image) + ", " + b.name + " has " +
                         window_text(b.image) + ": only equal windows can be compared");
}

std::vector<ChannelPair> common_channels(const Image& image, const Image& reference,
                                         const std::string& layer) {
    std::vector<ChannelPair> color, all;
    const auto take = [&](std::vector<ChannelPair>& pairs, const std::string& name) {
        const Channel* a = find_channel(image, name);
        const Channel* b = find_channel(reference, name);
        if (a && b) pairs.push_back({name, a->values, b->values});
    };
    const std::string prefix = layer.empty() ? "" : layer + ".";
    for (const std::string& name : color_channels)
        take(color, prefix + name);
    if (!color.empty() && !is_alpha(color.front().name)) return color;
    for (const Channel& channel : image.channels)
        if (layer_of(channel.name) == layer) take(all, channel.name);
    return all;
}

Comparison compare_images(const NamedImage& image, const NamedImage& reference,
                          const ComparisonOptions& options,
                          const std::optional<VarianceInput>& variance) {
    check_windows(image, reference);
    const std::vector<ChannelPair> pairs =
        common_channels(image.image, reference.image, options.layer);
    if (pairs.empty())
        throw InputError("no common channels in " +
                         (options.layer.empty() ? "the main layer" : "layer " + options.layer) +
                         ": " + image.name + " has " + channel_names(image.image) + ", " +
                         reference.name + " has " + channel_names(reference.image));
    Comparison comparison;
    comparison.width = image.image.width;
    comparison.height = image.image.height;
    for (const ChannelPair& pair : pairs)
        comparison.channels.push_back(pair.name);
    comparison.non_finite = count_non_finite(pairs, comparison.width);
    check_finite(image, reference, comparison.non_finite);
    for (const ChannelPair& pair : pairs)
        if (std::none_of(pair.image.begin(), pair.image.end(),
                         [](float v) { return std::isfinite(v); }))
            throw InputError(image.name + ": channel " + pair.name + " has no finite value");
    comparison.equal = all_equal(pairs);
    comparison.others = compare_other_channels(image.image, reference.image, comparison.channels,
                                               options.layer, options.left_out_layers);
    comparison.metrics = compute_metrics(pairs, comparison.width, options.epsilon);
    comparison.flip = flip_figures(pairs, comparison.non_finite, options.layer, comparison.width,
                                   comparison.height, options.pixels_per_degree);
    if (variance) add_z_test(comparison, pairs, reference, *variance);
    return comparison;
}

} // namespace parhelion
