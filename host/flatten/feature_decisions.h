// Which features the kernels of a scene have, and of each what was found that decides it.
#pragma once

#include "host/feature_set.h"

#include <array>
#include <map>
#include <string>

namespace parhelion {

class FeatureDecisions {
public:
    /// `why`: what was found, e.g. "2 of 5 materials". Throws std::logic_error for a feature that
    /// is decided already.
    void decide(Feature f, bool on, std::string why);

    bool has(Feature f) const { return on_.has(f); }
    const FeatureSet& on() const { return on_; }
    const std::string& why(Feature f) const { return reasons_[f]; }
    /// By name, of all that are decided.
    std::map<std::string, std::string> reasons() const;

    /// Decisions are the same; what was found is not compared.
    bool operator==(const FeatureDecisions& other) const { return on_ == other.on_; }

private:
    FeatureSet on_;
    std::array<std::string, feature_count> reasons_;
};

} // namespace parhelion
