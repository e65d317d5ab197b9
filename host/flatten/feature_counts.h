// Features that are decided by how many records need them.
#pragma once

#include "host/flatten/feature_decisions.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <string>

namespace parhelion {

inline std::string counted(std::size_t count, const char* one) {
    return fmt::format("{} {}{}", count, one, count == 1 ? "" : "s");
}

struct Count {
    bool any;
    std::string text; ///< "2 of 5 materials"
};

template<class Records, class Needs>
Count count_of(const Records& records, const char* name, Needs needs) {
    auto count = std::count_if(records.begin(), records.end(), needs);
    return {count > 0, fmt::format("{} of {} {}", count, records.size(), name)};
}

/// A feature that any of them needs.
template<class Records, class Needs>
void decide_by_count(FeatureDecisions& out, Feature f, const Records& records, const char* name,
                     Needs needs) {
    Count count = count_of(records, name, needs);
    out.decide(f, count.any, count.text);
}

inline void decide_by_request(FeatureDecisions& out, Feature f, bool asked) {
    out.decide(f, asked, asked ? "asked for" : "not asked for");
}

template<std::size_t N, class Records, class KindOf>
void decide_kinds(FeatureDecisions& out, const std::array<Feature, N>& features,
                  const Records& records, const char* name, KindOf kind_of) {
    for (std::size_t kind = 0; kind < N; kind++)
        decide_by_count(out, features[kind], records, name, [&](const auto& record) {
            return static_cast<std::size_t>(kind_of(record)) == kind;
        });
}

} // namespace parhelion
