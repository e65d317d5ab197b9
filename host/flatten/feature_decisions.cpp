// What each feature is decided by, gathered once.
#include "host/flatten/feature_decisions.h"

#include <stdexcept>
#include <utility>

namespace parhelion {

void FeatureDecisions::decide(Feature f, bool on, std::string why) {
    if (!reasons_[f].empty())
        throw std::logic_error(std::string(feature_name(f)) + " is decided twice");
    on_.set(f, on);
    reasons_[f] = std::move(why);
}

std::map<std::string, std::string> FeatureDecisions::reasons() const {
    std::map<std::string, std::string> by_name;
    for (int f = 0; f < feature_count; f++)
        if (!reasons_[f].empty()) by_name[feature_name(static_cast<Feature>(f))] = reasons_[f];
    return by_name;
}

} // namespace parhelion
