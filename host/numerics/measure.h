// The shared maths in both precisions as template parameters, random inputs, and distances in ulps.
#pragma once

#include <cmath>
#include <cstdint>
#include <limits>
#include <random>
#include <string>

#include "host/shared_maths.h"

namespace parhelion::numerics {

#define PRECISION(Name, space)                                                                     \
    struct Name {                                                                                  \
        using Real = space::Real;                                                                  \
        using Vec2 = space::vec2;                                                                  \
        using Vec3 = space::vec3;                                                                  \
        using Material = space::Material;                                                          \
        using Light = space::Light;                                                                \
        using Interface = space::Interface;                                                        \
    };
PRECISION(F32, f32)
PRECISION(F64, f64)
#undef PRECISION

template<class P>
typename P::Vec3 vec(double x, double y, double z) {
    using Real = typename P::Real;
    return {Real(x), Real(y), Real(z)};
}
template<class P, class V>
typename P::Vec3 vec_as(V v) {
    return vec<P>(v.x, v.y, v.z);
}
inline f64::vec3 wide(f32::vec3 v) { return {v.x, v.y, v.z}; }

inline f32::Primitive primitive_of(const PrimitiveRecord& record) {
    f32::Primitive p{};
#define COPY_FIELD(type, name) p.name = record.name;
    PRIMITIVE_FIELDS(COPY_FIELD)
#undef COPY_FIELD
    return p;
}

/// What the record of a triangle keeps in `extra`.
inline float inverse_normal_length(const f32::Primitive& p) {
    f64::vec3 a = wide(f32::primitive_a(p)), b = wide(f32::primitive_b(p)),
              c = wide(f32::primitive_c(p));
    return float(1 / f64::length3(f64::cross3(f64::sub3(b, a), f64::sub3(c, a))));
}

/// Random numbers with a fixed seed; floats on the device's grid of 2^-24.
class Random {
public:
    explicit Random(std::uint64_t seed) : engine_(seed) {}
    std::uint32_t bits() { return std::uint32_t(engine_() >> 32); }
    double unit() { return double(engine_() >> 40) * 0x1p-24; }
    double between(double low, double high) { return low + (high - low) * unit(); }
    double log_between(double low, double high) {
        return std::exp(between(std::log(low), std::log(high)));
    }
    double sign() { return engine_() >> 63 ? 1 : -1; }
    template<class P>
    typename P::Vec2 square() {
        using Real = typename P::Real;
        Real x = Real(unit());
        return {x, Real(unit())};
    }
    /// Uniform on the sphere, rounded to the precision P.
    template<class P>
    typename P::Vec3 direction() {
        double z = between(-1, 1), phi = between(0, 2 * M_PI), r = std::sqrt(1 - z * z);
        return vec<P>(r * std::cos(phi), r * std::sin(phi), z);
    }
    template<class P>
    typename P::Vec3 point(double half_width) {
        double x = between(-half_width, half_width), y = between(-half_width, half_width);
        return vec<P>(x, y, between(-half_width, half_width));
    }

private:
    std::mt19937_64 engine_;
};

/// Unit in the last place of a Real of x's magnitude.
template<class Real>
long double ulp_of(long double x) {
    int exponent = 0;
    std::frexp(std::fabs(x), &exponent);
    exponent = std::max(exponent, std::numeric_limits<Real>::min_exponent);
    return std::ldexp(1.0L, exponent - std::numeric_limits<Real>::digits);
}

/// |value - truth| in units of the last place of the truth.
template<class Real>
double ulps(Real value, long double truth) {
    if (std::isnan(value) || std::isnan(truth)) return std::numeric_limits<double>::infinity();
    if ((long double)value == truth) return 0;
    return double(std::fabs((long double)value - truth) / ulp_of<Real>(truth));
}

/// The largest of many numbers, NaN counting as infinite.
class Worst {
public:
    void add(double x) { worst_ = x <= worst_ ? worst_ : std::isnan(x) ? INFINITY : x; }
    double value() const { return worst_; }

private:
    double worst_ = 0;
};

/// A dielectric interface from the relative index as the host makes it: eta^2 - 1 in two parts.
template<class P>
typename P::Interface interface_of(double eta) {
    using Real = typename P::Real;
    long double m = ((long double)eta - 1) * ((long double)eta + 1);
    typename P::Interface i;
    i.eta = Real(eta);
    i.inv_eta = Real(1.0L / eta);
    i.m_high = Real(m);
    i.m_low = Real(m - i.m_high);
    return i;
}

} // namespace parhelion::numerics
