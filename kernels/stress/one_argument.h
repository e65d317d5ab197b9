// Functions of one number, by the bits of their argument: few enough to try them all.

FN Real one_sine(Uint bits) { return sincos_turns(intWord(bits)).sine; }
FN Real one_cosine(Uint bits) { return sincos_turns(intWord(bits)).cosine; }
FN Real one_exp_negative(Uint bits) { return exp_negative(intWord(bits)); }
FN Real one_one_minus_exp(Uint bits) { return one_minus_exp(intWord(bits)); }
FN Real one_acos(Uint bits) { return acosR(intWord(bits)); }
FN Real one_log_unit(Uint bits) { return log_unit(intWord(bits)); }
FN Real one_log_one_minus(Uint bits) { return log_one_minus(intWord(bits)); }
FN Real one_scaled_erfc(Uint bits) { return scaled_erfc(intWord(bits)); }
FN Real one_gaussian_quantile(Uint bits) { return gaussian_quantile(intWord(bits)); }
FN Real one_uniform01(Uint bits) { return uniform01(bits); }

// name; first and last bits of each of two ranges of arguments; from one to the next
// clang-format off
#define ONE_ARGUMENT_FUNCTIONS(X)                                                                  \
    X(sine,         0x00000000u, 0x3f800000u, 1u, 0u, 1)                   /* turns, 0 to 1 */        \
    X(cosine,       0x00000000u, 0x3f800000u, 1u, 0u, 1)                                              \
    X(exp_negative, 0x80000000u, 0xc2ae999au, 1u, 0u, 1)                   /* -0 to -87.3 */          \
    X(one_minus_exp, 0x80000000u, 0xc2ae999au, 1u, 0u, 1)                  /* likewise */             \
    X(acos,         0x00000000u, 0x3f800000u, 0x80000000u, 0xbf800000u, 1) /* 0 to 1, -0 to -1 */     \
    X(log_unit,     0x00800000u, 0x3f800000u, 1u, 0u, 1)                   /* 2^-126 to 1 */          \
    X(log_one_minus, 0x00000000u, 0x3f7fffffu, 1u, 0u, 1)                  /* 0 to 1 - 2^-24 */       \
    X(scaled_erfc,  0x00000000u, 0x7cf0bdc2u, 1u, 0u, 1)                   /* 0 to 1e37 */            \
    X(gaussian_quantile, 0x33000000u, 0x3f7fffffu, 1u, 0u, 1)              /* 2^-25 to 1 - 2^-24 */   \
    X(uniform01,    0x00000000u, 0xffffffffu, 1u, 0u, 255)                 /* integers, whose last 8 bits do not count */
// clang-format on
