// What the kernels of a render have: a set over the lists in kernels/shared/features.h.
#pragma once

#include "kernels/shared/features.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <string>
#include <vector>

namespace parhelion {

/// As in the lists, e.g. "bsdf_diffuse".
const char* feature_name(Feature f);

class FeatureSet {
public:
    constexpr FeatureSet() = default;
    constexpr FeatureSet(std::initializer_list<Feature> features) {
        for (Feature f : features)
            set(f);
    }
    static constexpr FeatureSet all() {
        FeatureSet every;
        for (int f = 0; f < feature_count; f++)
            every.set(static_cast<Feature>(f));
        return every;
    }

    constexpr bool has(Feature f) const { return (words_[f / word_bits] >> (f % word_bits)) & 1u; }
    constexpr bool empty() const { return *this == FeatureSet(); }
    constexpr void set(Feature f, bool on = true) {
        std::uint64_t bit = std::uint64_t{1} << (f % word_bits);
        std::uint64_t& word = words_[f / word_bits];
        word = on ? word | bit : word & ~bit;
    }

    constexpr bool operator==(const FeatureSet&) const = default;
    /// Some order, for sets of these.
    bool operator<(const FeatureSet& other) const { return words_ < other.words_; }
    /// Those of either.
    constexpr FeatureSet operator|(const FeatureSet& other) const {
        FeatureSet both;
        for (std::size_t k = 0; k < word_count; k++)
            both.words_[k] = words_[k] | other.words_[k];
        return both;
    }
    /// Those of both.
    constexpr FeatureSet operator&(const FeatureSet& other) const {
        FeatureSet both;
        for (std::size_t k = 0; k < word_count; k++)
            both.words_[k] = words_[k] & other.words_[k];
        return both;
    }
    /// Those that are not in the other.
    constexpr FeatureSet operator-(const FeatureSet& other) const {
        FeatureSet rest;
        for (std::size_t k = 0; k < word_count; k++)
            rest.words_[k] = words_[k] & ~other.words_[k];
        return rest;
    }

    /// In the order of the lists.
    std::vector<std::string> names() const;
    /// And back. Throws InputError for a name that is none.
    static FeatureSet of(const std::vector<std::string>& names);
    /// As the definitions that HAS() reads in OpenCL C, for the compiler's command line.
    std::string definitions() const;

private:
    static constexpr int word_bits = 64, word_count = FEATURE_WORDS;
    std::array<std::uint64_t, word_count> words_{};
};

} // namespace parhelion
