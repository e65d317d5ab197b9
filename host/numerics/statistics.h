// Statistics for tests: chi-square with pooled cells, normal tails, and the Sidak bound for many
// tests at once.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

namespace parhelion::numerics {

/// Regularised upper incomplete gamma function Q(a, x), a > 0, x >= 0: series below a + 1, Lentz's
/// continued fraction above (Abramowitz and Stegun 6.5.29 and 6.5.31).
inline double gamma_upper_regularised(double a, double x) {
    if (x <= 0) return 1;
    double scale = std::exp(a * std::log(x) - x - std::lgamma(a));
    if (x < a + 1) {
        double term = 1 / a, sum = term;
        for (double n = a + 1; term > sum * 1e-17; n++)
            sum += term *= x / n;
        return 1 - scale * sum;
    }
    double b = x + 1 - a, c = 1e300, d = 1 / b, fraction = d;
    for (int n = 1; n < 100000; n++) {
        double numerator = -n * (n - a);
        b += 2;
        d = 1 / (numerator * d + b);
        c = b + numerator / c;
        fraction *= d * c;
        if (std::fabs(d * c - 1) < 1e-15) break;
    }
    return scale * fraction;
}

/// Probability that a chi-square variable with `freedom` degrees exceeds `statistic`.
inline double chi_square_tail(double statistic, double freedom) {
    return gamma_upper_regularised(freedom / 2, statistic / 2);
}

/// Two-sided p-value of a standard normal deviate.
inline double normal_two_sided(double z) { return std::erfc(std::fabs(z) / std::sqrt(2.0)); }

/// Two-sided p-value of Student's t with a whole number of degrees of freedom (Abramowitz and
/// Stegun 26.7.3 and 26.7.4).
inline double student_two_sided(double t, int freedom) {
    const double angle = std::atan2(std::fabs(t), std::sqrt(double(freedom)));
    const double c2 = std::cos(angle) * std::cos(angle);
    const bool odd = freedom % 2 == 1;
    double term = odd ? std::cos(angle) : 1, sum = freedom == 1 ? 0 : term;
    for (int k = odd ? 3 : 2; k <= freedom - 2; k += 2)
        sum += term *= c2 * (k - 1) / k;
    const double inside =
        odd ? (angle + std::sin(angle) * sum) * 2 / 3.14159265358979323846 : std::sin(angle) * sum;
    return 1 - inside;
}

/// Probability that numbers uniform in [0, 1] are as far from evenly spread as these (Kolmogorov
/// and Smirnov; the tail by Stephens 1970).
inline double kolmogorov_smirnov_p(std::vector<double> values) {
    if (values.empty()) return 1;
    std::sort(values.begin(), values.end());
    auto n = double(values.size());
    double distance = 0;
    for (std::size_t i = 0; i < values.size(); i++)
        distance = std::max({distance, double(i + 1) / n - values[i], values[i] - double(i) / n});
    double x = (std::sqrt(n) + 0.12 + 0.11 / std::sqrt(n)) * distance, sum = 0;
    if (x < 0.2) return 1; // where the series converges slowly, to 1
    for (int k = 1; k < 100; k++)
        sum += (k % 2 ? 2 : -2) * std::exp(-2 * double(k) * double(k) * x * x);
    return std::clamp(sum, 0., 1.);
}

/// The level each of n independent tests must keep so that all together keep `family` (Sidak 1967).
inline double sidak_level(double family, std::size_t n) {
    return -std::expm1(std::log1p(-family) / double(n));
}

/// p-value of Pearson's chi-square for counts against expected counts of the same total. Cells are
/// pooled in rising order of expectation until each pool expects at least 5; a count where (next
/// to) nothing is expected gives 0.
inline double chi_square_p(const std::vector<double>& observed,
                           const std::vector<double>& expected) {
    std::vector<std::size_t> order(observed.size());
    for (std::size_t i = 0; i < order.size(); i++)
        order[i] = i;
    std::stable_sort(order.begin(), order.end(),
                     [&](std::size_t i, std::size_t j) { return expected[i] < expected[j]; });
    double pool_observed = 0, pool_expected = 0, statistic = 0;
    std::size_t pools = 0, left = order.size();
    for (std::size_t i : order) {
        if (pool_expected < 5 && pool_observed > 50)
            return 0; // p below 1e-30, however it is pooled
        pool_observed += observed[i];
        pool_expected += expected[i];
        left--;
        if (pool_expected < 5 && left > 0) continue;
        if (pool_expected < 5 && pools > 0 && pool_observed < 30)
            break; // a last, small pool: nothing to learn
        double difference = pool_observed - pool_expected;
        statistic += difference * difference / std::max(pool_expected, 1e-9);
        pool_observed = pool_expected = 0;
        pools++;
    }
    return pools < 2 ? (statistic > 30 ? 0 : 1) : chi_square_tail(statistic, double(pools - 1));
}

/// Running mean and variance (Welford 1962).
class Mean {
public:
    void add(double x) {
        count_++;
        double delta = x - mean_;
        mean_ += delta / double(count_);
        squares_ += delta * (x - mean_);
    }
    double mean() const { return mean_; }
    /// Standard error of the mean.
    double error() const {
        if (count_ < 2) return std::numeric_limits<double>::infinity();
        return std::sqrt(squares_ / (double(count_) - 1) / double(count_));
    }

private:
    std::size_t count_ = 0;
    double mean_ = 0, squares_ = 0;
};

} // namespace parhelion::numerics
