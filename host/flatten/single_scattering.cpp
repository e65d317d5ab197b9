// The share of light that a rough surface sends on by single scattering, in double.
//
// It is the mean, over visible normals, of what each sends on and is not masked. Normals are chosen
// by two numbers, an azimuth u and a height v: an integral over v with its kinks known (where
// reflections or refractions start to leave, where total reflection starts), and an adaptive one
// over u.
#include "host/flatten/single_scattering.h"

#include "host/flatten/gauss_legendre.h"

#include <cmath>
#include <vector>

namespace parhelion {
namespace {

/// The visible normals of one azimuth. Drawn as those of GGX, Beckmann's too: an integrand of u
/// and v as smooth as its.
struct Slice {
    const RoughSide& side;
    f64::vec3 wo;
    f64::vec3 stretched;
    f64::SinCos azimuth;
};

f64::vec3 normal_at(const Slice& slice, double v) {
    const f64::Material& m = slice.side.material;
    return f64::ggx_visible_normal(slice.stretched, slice.azimuth, v, m.alpha_u, m.alpha_v);
}

double weight_of(const Slice& slice, f64::vec3 h) {
    const f64::Material& m = slice.side.material;
    if (!f64::is_beckmann(m)) return 1.0;
    return f64::microfacet_visible_d(m, slice.wo, h) /
           f64::ggx_visible_d(slice.wo, h, m.alpha_u, m.alpha_v);
}

double share_sent_on(const Slice& slice, double v) {
    const RoughSide& side = slice.side;
    f64::vec3 h = normal_at(slice, v);
    double cosine = f64::dot3(slice.wo, h);
    if (!(cosine > 0.0)) return 0.0;
    double weight = weight_of(slice, h);
    f64::vec3 reflected = f64::reflect_about(slice.wo, h);
    double unmasked = reflected.z > 0.0 ? f64::microfacet_g1(side.material, reflected) : 0.0;
    if (!side.is_interface) return weight * unmasked;
    f64::Fresnel f = f64::fresnel_dielectric(cosine, side.face);
    double share = side.sent == Sent::refracted ? 0.0 : f.reflectance * unmasked;
    f64::vec3 refracted = f64::refract_about(slice.wo, h, cosine, f.g, side.face);
    if (refracted.z < 0.0 && side.sent != Sent::reflected) {
        refracted.z = -refracted.z;
        share += f.transmittance * f64::microfacet_g1(side.material, refracted);
    }
    return weight * share;
}

enum WhatLeaves { nothing = 0, reflection = 1, refraction = 2, inner_refraction = 4 };

/// Which of reflection and refraction there is above and below the surface, for a normal.
int what_leaves(const Slice& slice, double v) {
    const RoughSide& side = slice.side;
    f64::vec3 h = normal_at(slice, v);
    double cosine = f64::dot3(slice.wo, h);
    if (!(cosine > 0.0)) return nothing;
    int leaves = f64::reflect_about(slice.wo, h).z > 0.0 ? reflection : nothing;
    if (!side.is_interface) return leaves;
    double g = f64::fresnel_dielectric(cosine, side.face).g;
    if (!(g > 0.0)) return leaves;
    bool below = f64::refract_about(slice.wo, h, cosine, g, side.face).z < 0.0;
    return leaves | (below ? refraction : inner_refraction);
}

/// Integral over v from `low` to `high`, where f may start and end like a square root.
template<class F>
double between_kinks(const F& f, double low, double high) {
    static const GaussLegendre<12> rule;
    double width = high - low;
    return width * rule.integrate([&](double x) {
        return 6.0 * x * (1.0 - x) * f(low + width * x * x * (3.0 - 2.0 * x));
    });
}

/// Integral over v for one u.
double over_heights(const Slice& slice) {
    constexpr int steps = 16, halvings = 16;
    auto share = [&](double v) { return share_sent_on(slice, v); };
    auto leaves = [&](double v) { return what_leaves(slice, v); };
    double sum = 0.0, start = 0.0, at = 0.0;
    int here = leaves(0.0);
    auto end_piece = [&](double end) {
        if (here & (reflection | refraction)) sum += between_kinks(share, start, end);
        start = at = end;
    };
    for (int step = 1; step <= steps;) {
        double next = step < steps ? static_cast<double>(step) / steps : 1.0 - 0x1p-40;
        int there = leaves(next);
        if (there == here) {
            at = next;
            step++;
            continue;
        }
        double low = at, high = next;
        for (int k = 0; k < halvings; k++) {
            double middle = 0.5 * (low + high);
            int found = leaves(middle);
            if (found == here) {
                low = middle;
            } else {
                high = middle;
                there = found;
            }
        }
        end_piece(high);
        here = there;
    }
    end_piece(1.0);
    return sum;
}

struct Sample {
    double x, y;
};

double simpson(const Sample& a, const Sample& m, const Sample& b) {
    return (b.x - a.x) / 6.0 * (a.y + 4.0 * m.y + b.y);
}

/// How far y is from the parabola that goes through a, m and b, halfway between a and m.
double from_parabola(double y, const Sample& a, const Sample& m, const Sample& b) {
    return std::fabs(y - 0.125 * (3.0 * a.y + 6.0 * m.y - b.y));
}

/// Adaptive Simpson rule from a to b, whose middle is m.
template<class F>
double integrate(const F& f, const Sample& a, const Sample& m, const Sample& b, double tolerance,
                 int depth) {
    Sample left = f(0.5 * (a.x + m.x)), right = f(0.5 * (m.x + b.x));
    double first = simpson(a, left, m), second = simpson(m, right, b);
    // Both sides: about a kink their errors have opposite signs.
    double error = from_parabola(left.y, a, m, b) + from_parabola(right.y, b, m, a);
    if (depth == 0 || error * (b.x - a.x) / 3.0 <= tolerance)
        return first + second + (first + second - simpson(a, m, b)) / 15.0;
    return integrate(f, a, left, m, tolerance, depth - 1) +
           integrate(f, m, right, b, tolerance, depth - 1);
}

} // namespace

f64::Material widened(const MaterialRecord& record) {
    f64::Material m{};
#define WIDEN(type, name) m.name = record.name;
    MATERIAL_FIELDS(WIDEN)
    return m;
}

double single_scattering(const RoughSide& side, f64::vec3 wo, bool symmetric) {
    constexpr double tolerance = 3e-4; // of the whole, for each piece
    constexpr int depth = 12;
    const f64::vec3 stretched =
        f64::stretched_direction(wo, side.material.alpha_u, side.material.alpha_v);
    auto f = [&](double u) {
        return Sample{u, over_heights({side, wo, stretched, f64::sincos_turns(u)})};
    };
    const double end = symmetric ? 0.5 : 1.0;
    constexpr int pieces = 4;
    std::vector<Sample> samples;
    for (int n = 0; n <= 2 * pieces; n++)
        samples.push_back(f(end * n / (2 * pieces)));
    double estimate = 0.0, sum = 0.0;
    for (int n = 0; n < 2 * pieces; n += 2)
        estimate += simpson(samples[n], samples[n + 1], samples[n + 2]);
    for (int n = 0; n < 2 * pieces; n += 2)
        sum +=
            integrate(f, samples[n], samples[n + 1], samples[n + 2], tolerance * estimate, depth);
    return sum / end;
}

} // namespace parhelion
