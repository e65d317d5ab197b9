// Vectors of lanes and the elementary functions whose bits must be the same on every device.

#define PI 3.14159265358979323846
#define TWO_PI 6.28318530717958647693
#define INV_PI 0.31830988618379067154
#define INV_PI_HIGH 0.3183098733425140380859375 // 1 / pi in two parts, the first exact as a float
#define INV_PI_LOW 1.28412766334518e-8
#define INV_TWO_PI 0.15915494309189533577
#define INV_FOUR_PI 0.07957747154594766788

typedef struct {
    Real x, y;
} vec2;
typedef struct {
    Real x, y, z;
} vec3;

FN vec2 v2(Real x, Real y) {
    vec2 r;
    r.x = x;
    r.y = y;
    return r;
}
FN vec3 v3(Real x, Real y, Real z) {
    vec3 r;
    r.x = x;
    r.y = y;
    r.z = z;
    return r;
}
FN vec3 splat3(Real s) { return v3(s, s, s); }
FN vec3 add3(vec3 a, vec3 b) { return v3(a.x + b.x, a.y + b.y, a.z + b.z); }
FN vec3 sub3(vec3 a, vec3 b) { return v3(a.x - b.x, a.y - b.y, a.z - b.z); }
FN vec3 mul3(vec3 a, vec3 b) { return v3(a.x * b.x, a.y * b.y, a.z * b.z); }
FN vec3 scale3(vec3 a, Real s) { return v3(a.x * s, a.y * s, a.z * s); }
FN vec3 neg3(vec3 a) { return v3(-a.x, -a.y, -a.z); }
FN vec3 abs3(vec3 a) { return v3(absR(a.x), absR(a.y), absR(a.z)); }
FN vec3 sel3(Mask m, vec3 a, vec3 b) {
    return v3(sel(m, a.x, b.x), sel(m, a.y, b.y), sel(m, a.z, b.z));
}
FN Real dot3(vec3 a, vec3 b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
FN Real mean_component(vec3 a) { return (a.x + a.y + a.z) * R(.333333333333333333); }
FN Real max_component(vec3 a) { return maxR(a.x, maxR(a.y, a.z)); }
FN Real length3(vec3 a) { return sqrtR(dot3(a, a)); }
FN vec3 normalize3(vec3 a) { return scale3(a, R(1.) / length3(a)); }
FN Mask finite3(vec3 a) { return finiteR(a.x) & finiteR(a.y) & finiteR(a.z); }
FN Real square(Real x) { return x * x; }

/// a*b - c*d within 1.5 ulp, so that its sign is exact (Kahan; Jeannerod et al. 2013).
FN Real difference_of_products(Real a, Real b, Real c, Real d) {
    Real cd = c * d;
    return fmaR(a, b, -cd) + fmaR(-c, d, cd);
}

FN vec3 cross3(vec3 a, vec3 b) {
    return v3(difference_of_products(a.y, b.z, a.z, b.y),
              difference_of_products(a.z, b.x, a.x, b.z),
              difference_of_products(a.x, b.y, a.y, b.x));
}

/// A square root of what cannot be negative but for rounding.
FN Real sqrt_nonnegative(Real x) { return sqrtR(maxR(x, R(0.))); }

typedef struct {
    Real sine, cosine;
} SinCos;

#ifdef PARHELION_REAL_IS_DOUBLE
FN SinCos sincos_turns(Real u) {
    SinCos r;
    r.sine = std::sin(R(TWO_PI) * u);
    r.cosine = std::cos(R(TWO_PI) * u);
    return r;
}
FN Real exp_negative(Real x) { return std::exp(x); }
FN Real one_minus_exp(Real x) { return -std::expm1(x); }
FN Real atan2R(Real y, Real x) { return std::atan2(y, x); }
#else
/// sin and cos of 2 pi u, u in [0, 1]; absolute error below 1.2e-7. Minimax polynomials on [-pi/4,
/// pi/4] (Cephes).
FN SinCos sincos_turns(Real u) {
    Int quadrant = toInt(u * 4.f + .5f);
    Real x = (u * 4.f - toReal(quadrant)) * R(1.57079632679489662);
    Real z = x * x;
    Real s = x + x * z * (R(-1.6666654611e-1) + z * (R(8.3321608736e-3) + z * R(-1.9515295891e-4)));
    Real c = R(1.) - z * .5f +
             z * z *
                 (R(4.166664568298827e-2) +
                  z * (R(-1.388731625493765e-3) + z * R(2.443315711809948e-5)));
    Mask odd = (quadrant & 1) != 0;
    Real sine = sel(odd, c, s), cosine = sel(odd, s, c);
    SinCos r;
    r.sine = sel((quadrant & 2) != 0, -sine, sine);
    r.cosine = sel(((quadrant + 1) & 2) != 0, -cosine, cosine);
    return r;
}

/// exp(x) = (1 + beyond_one) 2^exponent, to 2e-7 of it, x from -88 to 0.
typedef struct {
    Real beyond_one;
    Int exponent;
} Exponential;

FN Exponential exponential(Real x) {
    Exponential e;
    e.exponent = toInt(x * R(1.44269504088896341) - .5f);
    Real t = toReal(e.exponent);
    Real r = (x - t * R(0.693359375)) - t * R(-2.12194440e-4);
    Real p = R(1.9875691500e-4);
    p = p * r + R(1.3981999507e-3);
    p = p * r + R(8.3334519073e-3);
    p = p * r + R(4.1665795894e-2);
    p = p * r + R(1.6666665459e-1);
    p = p * r + .5f;
    e.beyond_one = p * r * r + r;
    return e;
}

/// exp(x) for x <= 0, relative error below 2e-7; 0 where the result would be denormal (x < -87.3).
FN Real exp_negative(Real x) {
    // Of no number too; it is given back below.
    Exponential e = exponential(maxR(x, R(-88.)));
    Real y = scale_by_power_of_two(e.beyond_one + 1.f, e.exponent);
    return sel(x == x, sel(x < R(-87.3), R(0.), y), x);
}

/// 1 - exp(x) for x <= 0, without the loss of digits near 0; relative error below 2e-7.
FN Real one_minus_exp(Real x) {
    Exponential e = exponential(maxR(x, R(-88.)));
    Real scale = scale_by_power_of_two(R(1.), e.exponent);
    return sel(x == x, (R(1.) - scale) - scale * e.beyond_one, x);
}

/// atan2, absolute error below 3e-7; atan2(0, 0) = 0. Minimax polynomial on [0, tan(pi/8)]
/// (Cephes).
FN Real atan2R(Real y, Real x) {
    Real ax = absR(x), ay = absR(y);
    Real big = maxR(ax, ay), small = minR(ax, ay);
    Mask zero = big == R(0.);
    Mask steep = small > big * R(0.41421356237309505);
    Real numerator = sel(steep, small - big, small);
    Real denominator = sel(steep, small + big, big);
    Real t = numerator / sel(zero, R(1.), denominator);
    Real z = t * t;
    Real p = R(8.05374449538e-2);
    p = p * z + R(-1.38776856032e-1);
    p = p * z + R(1.99777106478e-1);
    p = p * z + R(-3.33329491539e-1);
    Real angle = p * z * t + t + sel(steep, R(0.78539816339744831), R(0.));
    angle = sel(ay > ax, R(1.57079632679489662) - angle, angle);
    angle = sel(x < R(0.), R(3.14159265358979324) - angle, angle);
    return copysignR(angle, y);
}
#endif

/// Angle whose cosine is x, x in [-1, 1], without the loss of digits near +-1.
FN Real acosR(Real x) { return atan2R(sqrt_nonnegative((R(1.) - x) * (R(1.) + x)), x); }
