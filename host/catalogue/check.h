// What the stress test finds: one check a row of the report.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace parhelion::numerics {} // namespace parhelion::numerics

namespace parhelion::stress {

using namespace numerics;

/// The worst value found at each place of a domain, to be drawn.
struct Curve {
    std::string axis{};          ///< what stands along it, e.g. "log10 cosine"
    double low = 0, high = 0;    ///< its ends
    std::vector<double> worst{}; ///< a bin each; negative: nothing fell into it
};

struct Check {
    std::string name{};           ///< unique: "row: what"
    double value = 0, target = 0; ///< holds where value <= target, or >= with at_least
    bool at_least = false;
    std::string unit{}; ///< "ulp", "rays", "p", ...
    std::uint64_t samples = 0;
    double mean = -1;       ///< negative: means nothing here
    std::string worst_at{}; ///< the inputs of the worst value
    std::string note{};
    Curve curve{};

    /// No number never holds.
    bool holds() const { return at_least ? value >= target : value <= target; }
};

using Checks = std::vector<Check>;

} // namespace parhelion::stress
