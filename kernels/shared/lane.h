// The lane layer: the only file that knows which language compiles the shared maths and how many
// values a Real holds.
//
// OpenCL C: LANES is 16, 8 or 1; Real, Int, Uint and Mask are vectors of that many values (or
// scalars). C++: one lane; PARHELION_REAL is float or double, and the file that includes this
// supplies <cmath>, <cstdint> and <limits>.
//
// Scalar is one value of a Real.
//
// Rules for everything written above it: values in, values out; no pointers; no `if` on a Mask
// except `if (someLane(m))` around work that is merged by sel(); masks combine with & and | and are
// negated with !; R(1.25) makes a constant of the Real's precision.

#ifdef __OPENCL_C_VERSION__
// -------------------------------------------------------------------------------------------------
// OpenCL C
#pragma OPENCL FP_CONTRACT OFF
#define FN static inline __attribute__((always_inline))
#define FN_APART static __attribute__((noinline)) // what is rarely called
#define R_(x) ((Real)(x##f))
#define R(x) R_(x)

#ifdef DECLARE_BUILTINS
// All of OpenCL's functions that kernels call, where the compiler is told not to read its own
// declarations: there are 14,000 of those, read at every start (PoCL: 0.04 s a program to find what
// it compiled before, 0.15 s to compile). A function that is called with integers has more types
// than are in use, so that no other argument is converted to them in silence.
#define BUILTIN __attribute__((overloadable, const))
size_t BUILTIN get_global_id(uint);
int BUILTIN clz(int);
uint BUILTIN clz(uint);
int BUILTIN popcount(int);
uint BUILTIN popcount(uint);
int BUILTIN min(int, int);
uint BUILTIN min(uint, uint);
float BUILTIN min(float, float);
int2 BUILTIN min(int2, int2);
int4 BUILTIN min(int4, int4);
int8 BUILTIN min(int8, int8);
#define BUILTINS_OF_WIDTH(n)                                                                       \
    float##n BUILTIN sqrt(float##n);                                                               \
    float##n BUILTIN floor(float##n);                                                              \
    float##n BUILTIN fma(float##n, float##n, float##n);                                            \
    float##n BUILTIN convert_float##n(int##n);                                                     \
    int##n BUILTIN convert_int##n##_rtz(float##n);
BUILTINS_OF_WIDTH()
BUILTINS_OF_WIDTH(8)
BUILTINS_OF_WIDTH(16)
float8 BUILTIN shuffle2(float8, float8, uint8);
float16 BUILTIN shuffle(float16, uint16);
#endif

// The x86 intrinsics have a portable twin each; PORTABLE switches them off so that the twins can be
// tested.
#if defined(__AVX512F__) && defined(__AVX512VL__) && !defined(PORTABLE)
#define LANE_AVX512
#endif

#if defined(__x86_64__) && defined(__clang__) && !defined(PORTABLE)
#define PREFETCH(p) __builtin_prefetch((const void*)(ulong)(p))
#else
#define PREFETCH(p)
#endif

typedef float Scalar;
#if LANES == 1
typedef float Real;
typedef int Int;
typedef uint Uint;
typedef int Mask; // 0 or 1
#define asInt as_int
#define asUint as_uint
#define asReal as_float
#define toReal(x) ((float)(x))
#define toInt(x) ((int)(x))
#define someLane(m) (m)
#define maskBits(m) ((uint)(m))
#define LANE_INDEX 0
#define lanesOf(bits) ((Mask)(bits))
#define lowestLane(v) (v)
#define lowestLaneInt(v) (v)
#define highestLane(v) (v)
#else
#define LANE_CAT_(a, b) a##b
#define LANE_CAT(a, b) LANE_CAT_(a, b)
typedef LANE_CAT(float, LANES) Real;
typedef LANE_CAT(int, LANES) Int;
typedef LANE_CAT(uint, LANES) Uint;
typedef LANE_CAT(int, LANES) Mask; // 0 or -1 in each lane
#define asInt LANE_CAT(as_int, LANES)
#define asUint LANE_CAT(as_uint, LANES)
#define asReal LANE_CAT(as_float, LANES)
#define toReal(x) LANE_CAT(convert_float, LANES)(x)
#define toInt(x) LANE_CAT(LANE_CAT(convert_int, LANES), _rtz)(x)
#if LANES == 16
#define LANE_INDEX ((Int)(0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15))
#else
#define LANE_INDEX ((Int)(0, 1, 2, 3, 4, 5, 6, 7))
#endif

// One bit a lane. OpenCL's any() compiles to a chain of branches; an OR-tree does not.
#if LANES == 16 && defined(LANE_AVX512)
FN uint maskBits(Mask m) { return (ushort)__builtin_ia32_cvtd2mask512(m); }
FN int someLane(Mask m) { return maskBits(m) != 0; }
#elif LANES == 16
FN uint maskBits(Mask m) {
    int16 bit =
        m & (int16)(1, 2, 4, 8, 16, 32, 64, 128, 256, 512, 1024, 2048, 4096, 8192, 16384, 32768);
    int8 a = bit.lo | bit.hi;
    int4 b = a.lo | a.hi;
    int2 c = b.lo | b.hi;
    return (uint)(c.x | c.y);
}
FN int someLane(Mask m) { return maskBits(m) != 0; }
#else
FN uint maskBits(Mask m) {
    int8 bit = m & (int8)(1, 2, 4, 8, 16, 32, 64, 128);
    int4 b = bit.lo | bit.hi;
    int2 c = b.lo | b.hi;
    return (uint)(c.x | c.y);
}
FN int someLane(Mask m) { return maskBits(m) != 0; }
#endif
#endif

#if LANES > 1
/// The lanes whose bits are set.
FN Mask lanesOf(uint bits) { return ((Int)(int)bits << (31 - LANE_INDEX)) < 0; }

#define LANE_LESS(a, b) ((a) < (b) ? (a) : (b))
#define LANE_MORE(a, b) ((a) > (b) ? (a) : (b))
#if LANES == 16
#define LANE_FOLD(v, f) f((v).lo, (v).hi)
#else
#define LANE_FOLD(v, f) (v)
#endif
/// The smallest and the largest value of all lanes, none of which is a NaN.
FN float lowestLane(Real v) {
    float8 w = LANE_FOLD(v, LANE_LESS);
    float4 x = LANE_LESS(w.lo, w.hi);
    float2 y = LANE_LESS(x.lo, x.hi);
    return LANE_LESS(y.x, y.y);
}
FN int lowestLaneInt(Int v) {
    int8 w = LANE_FOLD(v, min);
    int4 x = min(w.lo, w.hi);
    int2 y = min(x.lo, x.hi);
    return min(y.x, y.y);
}
FN float highestLane(Real v) {
    float8 w = LANE_FOLD(v, LANE_MORE);
    float4 x = LANE_MORE(w.lo, w.hi);
    float2 y = LANE_MORE(x.lo, x.hi);
    return LANE_MORE(y.x, y.y);
}
#endif

/// Position of the lowest set bit; bits != 0.
FN int lowest_bit(uint bits) { return 31 - (int)clz(bits & (0u - bits)); }

#define sqrtR(x) sqrt(x)
#define floorR(x) floor(x)
#define fmaR(a, b, c) fma(a, b, c)
FN Real absR(Real a) { return asReal(asUint(a) & 0x7fffffffu); }
FN Real copysignR(Real a, Real b) {
    return asReal((asUint(a) & 0x7fffffffu) | (asUint(b) & 0x80000000u));
}
FN Mask signsDiffer(Real a, Real b) { return (asInt(a) ^ asInt(b)) < 0; }
/// a, or where b has the negative sign -a.
FN Real flipSign(Real a, Real b) { return asReal(asUint(a) ^ (asUint(b) & 0x80000000u)); }
/// The largest power of two that is not above x; 0 where that is denormal; x >= 0 and finite.
FN Real powerOfTwoBelow(Real x) { return asReal(asUint(x) & 0x7f800000u); }
#define HALF_ULP 5.9604644775390625e-8f // of 1
#define LANE_NAN NAN
#define LANE_INFINITY INFINITY
#define finiteR(x) ((asUint(x) & 0x7f800000u) != 0x7f800000u)
/// x * 2^n, where neither x nor the result is zero, denormal or infinite.
FN Real scale_by_power_of_two(Real x, Int n) { return asReal(asInt(x) + n * 8388608); }
/// n with x 2^-n in [sqrt(1/2), sqrt(2)); x > 0, normal and finite.
FN Int nearestPowerOfTwo(Real x) { return (asInt(x) - 0x3f3504f3) >> 23; }
#define SINGLES_IN_REAL 1
FN Real singleR(Real x) { return x; }
/// The value of the lowest bit of a single's significand is 2^(this - 149).
FN Int lowestPlace(Real x) {
    Int exponent = asInt(asUint(x) >> 23 & 255u);
    return exponent > 0 ? exponent - 1 : (Int)0;
}
/// The 24 bits of a single; 2^23 of an infinite one.
FN Uint significand(Real x) {
    Uint fraction = asUint(x) & 0x7fffffu;
    return (asUint(x) & 0x7f800000u) != 0u ? fraction | 0x800000u : fraction;
}

#else
// ------------------------------------------------------------------------------------------------------
// C++
#define FN inline
#define FN_APART inline
#define LANES 1
#define PREFETCH(p)
typedef PARHELION_REAL Real;
typedef PARHELION_REAL Scalar;
typedef std::int32_t Int;
typedef std::uint32_t Uint;
typedef bool Mask;
#define R(x) ((Real)(x))
#define toReal(x) ((Real)(x))
#define toInt(x) ((std::int32_t)(x))
#define someLane(m) (m)
#define maskBits(m) ((Uint)(m))
#define LANE_INDEX 0
#define lanesOf(bits) ((Mask)(bits))
#define lowestLane(v) (v)
#define lowestLaneInt(v) (v)
#define highestLane(v) (v)
FN Int asInt(Uint x) { return (Int)x; }
FN Uint asUint(Int x) { return (Uint)x; }
FN Real sqrtR(Real x) { return std::sqrt(x); }
FN Real floorR(Real x) { return std::floor(x); }
FN Real fmaR(Real a, Real b, Real c) { return std::fma(a, b, c); }
FN Real absR(Real a) { return std::fabs(a); }
FN Real copysignR(Real a, Real b) { return std::copysign(a, b); }
FN Mask finiteR(Real x) { return std::isfinite(x); }
FN Real scale_by_power_of_two(Real x, Int n) { return std::ldexp(x, n); }
FN Int nearestPowerOfTwo(Real x) {
    Int below = std::ilogb(x);
    return below + (std::ldexp(x, -below) >= R(1.41421354));
}
#define SINGLES_IN_REAL (sizeof(Real) == sizeof(float) ? 1 : 3)
FN Real singleR(Real x) { return (float)x; }
FN Int lowestPlace(Real x) {
    if (x == 0 || !std::isfinite(x)) return 0;
    Int place = std::ilogb(x) + (149 - 23);
    return place > 0 ? place : 0;
}
FN Uint significand(Real x) {
    if (!std::isfinite(x)) return 0x800000u;
    return (Uint)std::ldexp(std::fabs(x), 149 - lowestPlace(x));
}
FN Mask signsDiffer(Real a, Real b) { return std::signbit(a) != std::signbit(b); }
FN Real flipSign(Real a, Real b) { return std::signbit(b) ? -a : a; }
FN Real powerOfTwoBelow(Real x) {
    return std::isnormal(x) ? std::ldexp(Real(1), std::ilogb(x)) : Real(0);
}
#define HALF_ULP (std::numeric_limits<Real>::epsilon() / 2) // of 1
#define LANE_NAN ((Real)NAN)
#define LANE_INFINITY ((Real)INFINITY)
#endif

// -----------------------------------------------------------------------------------------------
// everywhere
#define sel(mask, a, b) ((mask) ? (a) : (b))

// An `if` on what is seldom so: the code for it is put out of the way.
#if defined(__clang__) || defined(__GNUC__)
#define RARELY(x) (__builtin_expect((x) != 0, 0))
#else
#define RARELY(x) (x)
#endif

// Comparisons instead of fmin/fmax: those have NaN rules of their own and cost several
// instructions.
FN Real minR(Real a, Real b) { return sel(a < b, a, b); }
FN Real maxR(Real a, Real b) { return sel(a > b, a, b); }

// The neighbouring representable number, away from and towards minus infinity; x finite.
#ifdef __OPENCL_C_VERSION__
FN Real nextUp(Real x) {
    Real up = asReal(sel(x >= R(0.), asInt(x) + 1, asInt(x) - 1));
    return sel(x == R(0.), asReal((Int)1), up);
}
FN Real nextDown(Real x) { return -nextUp(-x); }
/// The neighbour of x on the side of `way`'s sign; x itself where `way` is zero.
FN Real nextAlong(Real x, Real way) {
    Int step = ((asInt(x) ^ asInt(way)) >> 31) | 1; // in magnitude
    Real next = sel(x == R(0.), copysignR(asReal((Int)1), way), asReal(asInt(x) + step));
    return sel((way > R(0.)) | (way < R(0.)), next, x);
}
#else
FN Real nextUp(Real x) { return std::nextafter(x, LANE_INFINITY); }
FN Real nextDown(Real x) { return std::nextafter(x, -LANE_INFINITY); }
FN Real nextAlong(Real x, Real way) {
    return sel(way > R(0.), nextUp(x), sel(way < R(0.), nextDown(x), x));
}
#endif
