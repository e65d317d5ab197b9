// Reconstruction filters as the device reads them: tables of values, or of equally likely bins.
#include "host/flatten/filter_table.h"

#include <cmath>
#include <cstddef>
#include <numbers>

namespace parhelion {
namespace {

constexpr int bin_count = 1024;
constexpr int cells_per_side = 1 << 16; // of the quadrature: mass errors below 1e-9

/// Mitchell and Netravali 1988, equation 8.
double cubic(double x, double b, double c) {
    double x2 = x * x, x3 = x2 * x;
    if (x < 1.0)
        return ((12.0 - 9.0 * b - 6.0 * c) * x3 + (-18.0 + 12.0 * b + 6.0 * c) * x2 +
                (6.0 - 2.0 * b)) /
               6.0;
    if (x < 2.0)
        return ((-b - 6.0 * c) * x3 + (6.0 * b + 30.0 * c) * x2 + (-12.0 * b - 48.0 * c) * x +
                (8.0 * b + 24.0 * c)) /
               6.0;
    return 0.0;
}

double sinc(double x) {
    double t = std::numbers::pi * x;
    return t == 0.0 ? 1.0 : std::sin(t) / t;
}

} // namespace

double filter_radius(const ReconstructionFilter& filter) {
    switch (filter.kind) {
    case FilterKind::box:
        return 0.5;
    case FilterKind::tent:
        return filter.radius > 0.0 ? filter.radius : 1.0;
    case FilterKind::gaussian:
        return 4.0 * filter.stddev;
    case FilterKind::mitchell:
    case FilterKind::catmullrom:
        return 2.0;
    case FilterKind::lanczos:
        return filter.lanczos_lobes;
    }
    return 0.5;
}

double filter_value(const ReconstructionFilter& filter, double x) {
    double distance = std::abs(x), radius = filter_radius(filter);
    if (distance > radius) return 0.0;
    switch (filter.kind) {
    case FilterKind::box:
        return 1.0;
    case FilterKind::tent:
        return 1.0 - distance / radius;
    case FilterKind::gaussian: {
        double alpha = -1.0 / (2.0 * filter.stddev * filter.stddev);
        return std::exp(alpha * x * x) - std::exp(alpha * radius * radius);
    }
    case FilterKind::mitchell:
        return cubic(distance, filter.mitchell_a, filter.mitchell_b);
    case FilterKind::catmullrom:
        return cubic(distance, 0.0, 0.5);
    case FilterKind::lanczos:
        return sinc(distance) * sinc(distance / radius);
    }
    return 0.0;
}

int filter_reach(const Film& film) {
    if (film.filter_method == FilterMethod::sampling) return 0;
    double reach = std::ceil(filter_radius(film.filter) + 0.5) - 1.0;
    return reach > FILTER_REACH_LIMIT ? 0 : static_cast<int>(reach);
}

std::vector<float> make_filter_values(const ReconstructionFilter& filter) {
    constexpr int count = FILTER_REACH_LIMIT * FILTER_INTERVALS + FILTER_INTERVALS / 2 + 2;
    std::vector<float> values(count);
    for (int n = 0; n < count; n++)
        values[n] = static_cast<float>(filter_value(filter, double(n) / FILTER_INTERVALS));
    return values;
}

std::vector<FilterBin> make_filter_table(const ReconstructionFilter& filter) {
    double radius = filter_radius(filter), cell = radius / cells_per_side;
    // Running integrals of |f| and of f at the borders of the cells.
    std::vector<double> absolute{0.0}, plain{0.0};
    for (int i = 0; i < 2 * cells_per_side; i++) {
        double value = filter_value(filter, -radius + (i + 0.5) * cell);
        absolute.push_back(absolute.back() + std::abs(value));
        plain.push_back(plain.back() + value);
    }
    std::vector<FilterBin> bins(bin_count + 1);
    std::size_t border = 0;
    double previous_plain = 0.0;
    bins[0].x = static_cast<float>(-radius);
    for (int b = 1; b <= bin_count; b++) {
        double mass = absolute.back() * b / bin_count;
        while (border + 2 < absolute.size() && absolute[border + 1] < mass)
            border++;
        double inside = (mass - absolute[border]) / (absolute[border + 1] - absolute[border]);
        double here = plain[border] + inside * (plain[border + 1] - plain[border]);
        bins[b].x = static_cast<float>(-radius + (static_cast<double>(border) + inside) * cell);
        bins[b - 1].weight = static_cast<float>((here - previous_plain) / plain.back() * bin_count);
        previous_plain = here;
    }
    return bins;
}

} // namespace parhelion
