// How many samples a pixel has, and how they lie.
#pragma once

#include <array>
#include <cstdint>
#include <string>

namespace parhelion {

/// How the samples of a pixel lie: Owen-scrambled points of a low-discrepancy sequence, or
/// independent random numbers.
#define SAMPLE_PATTERNS(X) X(faure) X(independent)
#define PATTERN_ENUM(name) name,
enum class SamplePattern { SAMPLE_PATTERNS(PATTERN_ENUM) };
#define PATTERN_NAME(name) #name,
inline constexpr std::array sample_pattern_names{SAMPLE_PATTERNS(PATTERN_NAME)};

struct Sampler {
    std::string plugin =
        "independent"; ///< as written; the pattern does not follow it (see Scene::notes)
    SamplePattern pattern = SamplePattern::faure;
    int samples_per_pixel = 16;
    int replicates = 1; ///< independently scrambled patterns that take turns, a power of two
    std::uint32_t seed = 0;
};

} // namespace parhelion
