// With which probability each cell of a sky's image is chosen.
#include "host/flatten/environment_shares.h"

#include "host/parallel.h"

#include <half.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <numbers>
#include <span>
#include <vector>

namespace parhelion {
namespace {

constexpr std::int64_t all_shares = std::int64_t{1} << 30;

/// Texels of an image, as the device reads them.
class Texels {
public:
    Texels(const DeviceScene& records, const TextureRecord& image)
        : image_(image), bytes_(std::as_bytes(std::span(records.texels))
                                    .subspan(4 * static_cast<std::size_t>(image.first))),
          byte_values_(std::span(records.byte_values)
                           .subspan(image.form & TEXTURE_LINEAR && !records.byte_values.empty()
                                        ? BYTE_VALUES / 2
                                        : 0)) {}

    int width() const { return image_.width; }
    int rows() const { return image_.height; }
    int components() const { return image_.form & TEXTURE_GREY ? 1 : 3; }

    double component(std::size_t number) const {
        switch (TEXTURE_COMPONENT(image_.form)) {
        case 0:
            return byte_values_[std::to_integer<std::size_t>(bytes_[number])];
        case 1:
            return read<Imath::half>(number);
        default:
            return read<float>(number);
        }
    }

private:
    template<class T>
    float read(std::size_t number) const {
        T value;
        std::memcpy(&value, &bytes_[number * sizeof(T)], sizeof(T));
        return value;
    }

    const TextureRecord& image_;
    std::span<const std::byte> bytes_;
    std::span<const float> byte_values_;
};

/// Of a row of texels: the mean of each one's components, and the largest of all.
struct TexelRow {
    std::vector<double> means;
    double peak = 0.0;
};

TexelRow texel_row(const Texels& texels, int row) {
    TexelRow out;
    auto width = static_cast<std::size_t>(texels.width());
    auto components = static_cast<std::size_t>(texels.components());
    out.means.resize(width);
    for (std::size_t x = 0; x < width; x++) {
        std::size_t first = (static_cast<std::size_t>(row) * width + x) * components;
        double sum = 0.0;
        for (std::size_t k = 0; k < components; k++) {
            double value = texels.component(first + k);
            sum += value;
            out.peak = std::max(out.peak, value);
        }
        out.means[x] = sum / static_cast<double>(components);
    }
    return out;
}

/// Integrals over the polar angle in a row of cells of its sine, times 1 - t and times t, where t
/// goes from 0 to 1 from its upper border to the lower one.
struct RowWeights {
    double upper, lower;
};

RowWeights row_weights(int row, int rows) {
    double height = std::numbers::pi / rows, first = row * height, last = (row + 1) * height;
    // Of t sin: by parts; differences of sines without cancellation.
    double sines = 2.0 * std::cos(0.5 * (first + last)) * std::sin(0.5 * height);
    double whole = 2.0 * std::sin(0.5 * (first + last)) * std::sin(0.5 * height);
    double lower = sines / height - std::cos(last);
    return {whole - lower, lower};
}

/// Shares of all_shares in proportion to `weights`, each as the sum of those before it, and the sum
/// of all; at least 1 for what is not 0. Into `to`, one longer.
void write_shares(std::span<const double> weights, double total, std::span<int> to) {
    auto some = std::count_if(weights.begin(), weights.end(), [](double w) { return w > 0.0; });
    double scale = total > 0.0 ? static_cast<double>(all_shares - some) / total : 0.0;
    double before = 0.0;
    std::int64_t least = 0;
    for (std::size_t k = 0; k < weights.size(); k++) {
        to[k] = static_cast<int>(std::llround(before * scale) + least);
        before += weights[k];
        least += weights[k] > 0.0 ? 1 : 0;
    }
    to[weights.size()] = static_cast<int>(total > 0.0 ? all_shares : 0);
}

/// Integrals of the brightness over the cells of a row; the angle of a column counts as 1.
std::vector<double> cell_weights(const TexelRow& upper, const TexelRow& lower, RowWeights w) {
    std::size_t width = upper.means.size();
    std::vector<double> weights(width);
    for (std::size_t x = 0; x < width; x++) {
        std::size_t next = x + 1 < width ? x + 1 : 0;
        weights[x] = 0.5 * (w.upper * (upper.means[x] + upper.means[next]) +
                            w.lower * (lower.means[x] + lower.means[next]));
    }
    return weights;
}

double sum_of(const std::vector<double>& values) {
    double sum = 0.0;
    for (double v : values)
        sum += v;
    return sum;
}

} // namespace

Environment make_environment(const DeviceScene& records, int texture, int lit_rows) {
    const Texels texels(records, records.textures[static_cast<std::size_t>(texture)]);
    auto rows = static_cast<std::size_t>(texels.rows()) - 1;
    auto width = static_cast<std::size_t>(texels.width());
    Environment out;
    out.texture = texture;
    out.shares.resize(rows + 1 + rows * (width + 1));
    const std::span<int> shares(out.shares);
    std::vector<double> sums(rows), peaks(rows);
    parallel_for(rows, [&](std::size_t row) {
        int number = static_cast<int>(row);
        TexelRow upper = texel_row(texels, number), lower = texel_row(texels, number + 1);
        std::vector<double> weights(width);
        if (number < lit_rows)
            weights = cell_weights(upper, lower, row_weights(number, static_cast<int>(rows)));
        sums[row] = sum_of(weights);
        peaks[row] = std::max(upper.peak, lower.peak);
        write_shares(weights, sums[row], shares.subspan(rows + 1 + row * (width + 1), width + 1));
    });
    double total = sum_of(sums);
    write_shares(sums, total, shares.first(rows + 1));
    out.mean = total / (2.0 * static_cast<double>(width));
    out.peak = *std::max_element(peaks.begin(), peaks.end());
    return out;
}

} // namespace parhelion
