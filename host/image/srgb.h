// The sRGB transfer function and the matrices between linear sRGB and XYZ (IEC 61966-2-1).
#pragma once

#include <array>
#include <cmath>

namespace parhelion {

/// Encodes a linear value in [0, 1]; both branches of the standard.
inline double srgb_encode(double linear) {
    return linear <= 0.0031308 ? 12.92 * linear : 1.055 * std::pow(linear, 1.0 / 2.4) - 0.055;
}

/// The linear value of an encoded one in [0, 1]; both branches of the standard.
inline double srgb_decode(double encoded) {
    return encoded <= 0.04045 ? encoded / 12.92 : std::pow((encoded + 0.055) / 1.055, 2.4);
}

using Matrix3 = std::array<std::array<double, 3>, 3>; ///< rows

inline std::array<double, 3> transform(const Matrix3& m, const std::array<double, 3>& v) {
    std::array<double, 3> out{};
    for (int i = 0; i < 3; ++i)
        out[i] = m[i][0] * v[0] + m[i][1] * v[1] + m[i][2] * v[2];
    return out;
}

/// XYZ to linear sRGB (D65) in the six digits Mitsuba and most renderers use (ITU-R BT.709).
inline constexpr Matrix3 xyz_to_srgb{{{3.240479, -1.537150, -0.498535},
                                      {-0.969256, 1.875991, 0.041556},
                                      {0.055648, -0.204043, 1.057311}}};

/// Inverse of a matrix that has one.
inline Matrix3 inverse(const Matrix3& m) {
    const auto minor = [&](int r, int c) {
        const int r1 = (r + 1) % 3, r2 = (r + 2) % 3, c1 = (c + 1) % 3, c2 = (c + 2) % 3;
        return m[r1][c1] * m[r2][c2] - m[r1][c2] * m[r2][c1];
    };
    const double determinant =
        m[0][0] * minor(0, 0) + m[0][1] * minor(0, 1) + m[0][2] * minor(0, 2);
    Matrix3 out{};
    for (int r = 0; r < 3; ++r)
        for (int c = 0; c < 3; ++c)
            out[r][c] = minor(c, r) / determinant;
    return out;
}

} // namespace parhelion
