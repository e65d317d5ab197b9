// The logarithm, the error function and its inverse, for what is spread like a Gaussian.

#define SQRT_PI 1.77245385090551602730
#define INV_SQRT_PI 0.56418958354775628695

#ifdef PARHELION_REAL_IS_DOUBLE
FN Real log_unit(Real x) { return std::log(x); }
FN Real log_one_minus(Real x) { return std::log1p(-x); }
/// erfc(y) exp(y^2), y >= 0.
FN Real scaled_erfc(Real y) {
    // Beyond 25 erfc is soon denormal: five terms of its asymptotic series (Abramowitz and Stegun
    // 7.1.23) are exact there.
    if (y < 25) return std::erfc(y) * std::exp(y * y);
    Real s = 1 / (2 * y * y);
    return INV_SQRT_PI / y * (1 - s * (1 - 3 * s * (1 - 5 * s * (1 - 7 * s))));
}
#else
/// log(x), x in (0, 1] and normal, absolute error below 1e-7 or relative below 2e-7. Minimax
/// polynomial on [sqrt(1/2), sqrt(2)] (Cephes).
FN Real log_unit(Real x) {
    Int exponent = nearestPowerOfTwo(x);
    Real m = scale_by_power_of_two(x, -exponent) - R(1.);
    Real z = m * m;
    Real p = R(7.0376836292e-2);
    p = p * m + R(-1.1514610310e-1);
    p = p * m + R(1.1676998740e-1);
    p = p * m + R(-1.2420140846e-1);
    p = p * m + R(1.4249322787e-1);
    p = p * m + R(-1.6668057665e-1);
    p = p * m + R(2.0000714765e-1);
    p = p * m + R(-2.4999993993e-1);
    p = p * m + R(3.3333331174e-1);
    Real e = toReal(exponent);
    Real small = p * m * z + e * R(-2.12194440e-4) - .5f * z;
    return m + small + e * R(0.693359375);
}

/// log(1 - x), x in [0, 1), relative error below 3e-7: what rounding 1 - x does to it by the slope
/// there (Kahan's way).
FN Real log_one_minus(Real x) {
    Real rest = R(1.) - x, taken = R(1.) - rest;
    Mask some = taken > R(0.);
    return sel(some, log_unit(rest) * (x / sel(some, taken, R(1.))), -x);
}

/// erfc(y) exp(y^2), y >= 0, relative error below 5e-7: a polynomial in 1 / (1 + 0.4 y), minimax.
FN Real scaled_erfc(Real y) {
    Real t = R(1.) / (R(1.) + R(.4) * y);
    Real p = R(5.02600169e-2);
    p = p * t + R(-1.82893703e-1);
    p = p * t + R(1.69073942e-1);
    p = p * t + R(-5.59879284e-3);
    p = p * t + R(1.41427803e-1);
    p = p * t + R(1.68542782e-1);
    p = p * t + R(2.07842613e-1);
    p = p * t + R(2.25669602e-1);
    p = p * t + R(2.25675862e-1);
    return p * t;
}
#endif

/// x with erfc(-x) = 2 t, t in (0, 1): where the integral of exp(-x^2) / sqrt(pi) has reached t.
/// Relative error below 4e-7. Giles 2010, "Approximating the erfinv function".
FN Real gaussian_quantile(Real t) {
    Real w = -log_unit(R(4.) * t * (R(1.) - t));
    Mask middle = w < R(5.);
    Real x = sel(middle, w - R(2.5), sqrt_nonnegative(w) - R(3.));
    Real p = sel(middle, R(2.81022636e-8), R(-2.00214257e-4));
    p = p * x + sel(middle, R(3.43273939e-7), R(1.00950558e-4));
    p = p * x + sel(middle, R(-3.5233877e-6), R(1.34934322e-3));
    p = p * x + sel(middle, R(-4.39150654e-6), R(-3.67342844e-3));
    p = p * x + sel(middle, R(2.1858087e-4), R(5.73950773e-3));
    p = p * x + sel(middle, R(-1.25372503e-3), R(-7.6224613e-3));
    p = p * x + sel(middle, R(-4.17768164e-3), R(9.43887047e-3));
    p = p * x + sel(middle, R(2.46640727e-1), R(1.00167406));
    p = p * x + sel(middle, R(1.50140941), R(2.83297682));
    return p * (R(2.) * t - R(1.));
}
