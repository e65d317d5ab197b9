// The sun and the sky by their formula, in double, and what the device gets of them.
#include "host/flatten/daylight.h"

#include "host/flatten/environment_shares.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <iterator>
#include <memory>
#include <numbers>
#include <span>
#include <utility>
#include <vector>

namespace parhelion {
namespace {

constexpr double pi = std::numbers::pi;

constexpr int turbidities = 10, albedos = 2, control_points = 6, sun_elevations = 30;

// As Mitsuba has them; their licence stands in both files.
constexpr double sky_figures[] = {
#include "host/flatten/daylight_sky.inl"
};
constexpr double sun_figures[] = {
#include "host/flatten/daylight_sun.inl"
};
static_assert(std::size(sky_figures) ==
              turbidities * albedos * control_points * 3 * DAYLIGHT_SKY_WORDS);
static_assert(std::size(sun_figures) == turbidities * sun_elevations * 3);

/// What the sums of the formula's colours are multiplied by (of the colour matching function y).
constexpr double inverse_luminous_sum = 1.0 / 106.7502593994140625;

/// A place between two of a row of entries: the first, and how far it is to the next.
struct Between {
    int first;
    double along;
};

/// x from 0 to count - 1.
Between between(double x, int count) {
    int first = std::min(static_cast<int>(x), count - 2);
    return {first, x - first};
}

double mixed(double a, double b, double along) { return a + (b - a) * along; }

double elevation_of(const SunskyEmitter& e) {
    return std::atan2(e.sun.y, std::hypot(e.sun.x, e.sun.z));
}

/// Figure `word` of a colour at a control point.
double sky_figure(const SunskyEmitter& e, int control, int color, int word) {
    auto at = [&](int turbidity, int albedo) {
        return sky_figures[(((turbidity * albedos + albedo) * control_points + control) * 3 +
                            color) *
                               DAYLIGHT_SKY_WORDS +
                           word];
    };
    Between t = between(e.turbidity - 1.0, turbidities);
    auto of_albedo = [&](int albedo) {
        return mixed(at(t.first, albedo), at(t.first + 1, albedo), t.along);
    };
    return mixed(of_albedo(0), of_albedo(1), e.albedo[color]);
}

/// Of Bernstein's polynomials of degree 5 at x.
std::array<double, control_points> control_weights(double x) {
    constexpr std::array<double, control_points> binomials{1, 5, 10, 10, 5, 1};
    std::array<double, control_points> weights{};
    for (int k = 0; k < control_points; k++)
        weights[k] = binomials[k] * std::pow(x, k) * std::pow(1.0 - x, control_points - 1 - k);
    return weights;
}

void set_sky(Daylight& d, const SunskyEmitter& e) {
    const std::array<double, control_points> weights =
        control_weights(std::min(std::cbrt(elevation_of(e) / (0.5 * pi)), 1.0));
    for (int color = 0; color < 3; color++) {
        for (int word = 0; word < DAYLIGHT_SKY_WORDS; word++)
            for (int k = 0; k < control_points; k++)
                d.colors[color][word] += weights[k] * sky_figure(e, k, color, word);
        d.colors[color].back() *= e.sky_scale * inverse_luminous_sum;
    }
}

void set_sun(Daylight& d, const SunskyEmitter& e) {
    constexpr double lowest = 2.0, step = 3.0; // degrees
    double place = (elevation_of(e) * 180.0 / pi - lowest) / step;
    Between high = between(std::clamp(place, 0.0, sun_elevations - 1.0), sun_elevations);
    Between t = between(e.turbidity - 1.0, turbidities);
    for (int color = 0; color < 3; color++) {
        auto at = [&](int turbidity) {
            const double* row = &sun_figures[3 * (turbidity * sun_elevations + high.first) + color];
            return mixed(row[0], row[3], high.along);
        };
        d.sun_radiance[color] =
            e.sun_scale * mixed(at(t.first), at(t.first + 1), t.along) / d.solid_angle();
    }
}

/// Of columns and rows; an even number of rows of cells, so that the horizon is a row of texels.
/// The variance of what a direction brings is 0.7 % of its mean's square at most; 128 x 65: 0.14 %.
constexpr int guide_width = 64, guide_rows = 33;

double brightness_of(const Rgb& c) {
    return (std::fabs(c.r) + std::fabs(c.g) + std::fabs(c.b)) / 3.0;
}

/// Of texels down to the horizon.
void fill_guide(const Daylight& daylight, std::span<std::byte> to) {
    std::vector<float> values(to.size() / sizeof(float));
    std::size_t texel = 0;
    for (int y = 0; 2 * y < guide_rows; y++)
        for (int x = 0; x < guide_width; x++) {
            double turn = 2.0 * pi * (x + 0.5) / guide_width, fall = pi * y / (guide_rows - 1);
            glm::dvec3 w(std::sin(turn) * std::sin(fall), std::cos(fall),
                         -std::cos(turn) * std::sin(fall));
            values[texel++] = static_cast<float>(brightness_of(daylight.sky_radiance(w)));
        }
    std::memcpy(to.data(), values.data(), to.size());
}

/// How many of 256 directions are chosen by the sky's table.
int sky_share(const Daylight& d, double of_sky, double of_sun) {
    if (!d.sun || !d.sky) return d.sky ? 256 : 0;
    return std::clamp(static_cast<int>(std::lround(256.0 * of_sky / (of_sky + of_sun))), 1, 255);
}

std::vector<double> words_of(const Daylight& d, double peak, int share) {
    std::vector<double> words(DAYLIGHT_WORDS);
    for (int k = 0; k < 3; k++) {
        words[DAYLIGHT_SUN_DIRECTION + k] = d.direction[k];
        words[DAYLIGHT_SUN_RADIANCE + k] = d.sun_radiance[k] / peak;
        auto first = words.begin() + DAYLIGHT_SKY + k * DAYLIGHT_SKY_WORDS;
        std::copy(d.colors[k].begin(), d.colors[k].end(), first);
        first[DAYLIGHT_SKY_WORDS - 1] /= peak;
    }
    words[DAYLIGHT_SUN_EDGE] = d.edge;
    words[DAYLIGHT_SKY_SHARE] = share;
    return words;
}

} // namespace

Rgb Daylight::sky_radiance(const glm::dvec3& w) const {
    double cosine = glm::dot(w, direction);
    double angle = 2.0 * std::atan2(glm::length(w - direction), glm::length(w + direction));
    double up = std::max(w.y, 0.0), square = cosine * cosine;
    Rgb radiance;
    for (int color = 0; color < 3; color++) {
        const auto& [a, b, c, d, e, f, g, i, h, scale] = colors[color];
        double aureole = (1.0 + square) / std::pow(1.0 + h * h - 2.0 * h * cosine, 1.5);
        double dome = c + d * std::exp(e * angle) + f * square + g * aureole + i * std::sqrt(up);
        radiance[color] = (1.0 + a * std::exp(b / (up + 0.01))) * dome * scale;
    }
    return radiance;
}

double Daylight::solid_angle() const { return pi * edge; }

Daylight daylight_of(const SunskyEmitter& e) {
    Daylight d;
    const double sine = std::sin(0.5 * e.half_aperture);
    d.edge = 4.0 * sine * sine;
    d.direction = e.sun;
    if (e.sun.y < 0.0) return d;
    d.sky = e.sky_scale > 0.0, d.sun = e.sun_scale > 0.0;
    if (d.sky) set_sky(d, e);
    if (d.sun) set_sun(d, e);
    return d;
}

TextureUse guide_of(const SunskyEmitter& emitter) {
    SunskyEmitter plain = emitter;
    plain.sky_scale =
        emitter.sky_scale > 0.0 ? 1.0 : 0.0; // floats do not hold what some make of it
    const Daylight daylight = daylight_of(plain);
    if (!daylight.sky) return {};
    BitmapTexture bitmap;
    bitmap.source.name = "the sky about the sun";
    bitmap.source.layout = {guide_width, guide_rows, 1, TexelComponent::single, false};
    bitmap.source.read = [daylight](std::span<std::byte> to) { fill_guide(daylight, to); };
    return {std::make_shared<const Texture>(Texture{"", glm::dmat3(1.0), bitmap}),
            {},
            "a sunsky",
            any_number()};
}

Environment daylight_environment(const SunskyEmitter& emitter, const DeviceScene& records,
                                 int texture) {
    const Daylight daylight = daylight_of(emitter);
    Environment out;
    if (daylight.sky) out = make_environment(records, texture, (guide_rows - 1) / 2);
    out.sun = daylight.sun;
    out.peak *= emitter.sky_scale;
    // Means over all directions.
    const double of_sky = out.mean * emitter.sky_scale;
    const double of_sun =
        brightness_of(daylight.sun_radiance) * daylight.solid_angle() / (4.0 * pi);
    for (int color = 0; color < 3; color++)
        out.peak = std::max(out.peak, std::fabs(daylight.sun_radiance[color]));
    if (!(out.peak > 0.0)) return out;
    const std::vector<double> words =
        words_of(daylight, out.peak, sky_share(daylight, of_sky, of_sun));
    LargeVector<int> shares(words.size() + out.shares.size());
    std::transform(words.begin(), words.end(), shares.begin(),
                   [](double word) { return std::bit_cast<int>(static_cast<float>(word)); });
    std::copy(out.shares.begin(), out.shares.end(), shares.begin() + DAYLIGHT_WORDS);
    out.shares = std::move(shares);
    out.mean = (of_sky + of_sun) / out.peak;
    return out;
}

void decide_daylight(const DeviceScene& records, FeatureDecisions& out) {
    const bool there = out.has(feature_emitter_sunsky);
    const char* found = there ? "a sunsky" : "no sunsky";
    out.decide(feature_daylight_sky, there && records.environment.texture >= 0, found);
    out.decide(feature_daylight_sun, there && records.environment.sun, found);
}

} // namespace parhelion
