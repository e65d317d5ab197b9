// The known name that a mistyped one is likely to mean.
#include "host/commands/nearest_name.h"

#include <algorithm>
#include <cstddef>
#include <numeric>

namespace parhelion {
namespace {

/// Letters added, left out or changed (Levenshtein 1966).
std::size_t edit_distance(const std::string& a, const std::string& b) {
    std::vector<std::size_t> row(b.size() + 1);
    std::iota(row.begin(), row.end(), std::size_t{0});
    for (std::size_t i = 0; i < a.size(); i++) {
        std::size_t diagonal = row[0];
        row[0] = i + 1;
        for (std::size_t k = 0; k < b.size(); k++) {
            std::size_t changed = diagonal + (a[i] == b[k] ? 0 : 1);
            diagonal = row[k + 1];
            row[k + 1] = std::min({row[k] + 1, row[k + 1] + 1, changed});
        }
    }
    return row.back();
}

} // namespace

std::string nearest_name(const std::string& name, const std::vector<std::string>& known) {
    std::string nearest;
    std::size_t least = name.size() / 3 + 1;
    for (const std::string& candidate : known) {
        std::size_t distance = edit_distance(name, candidate);
        if (distance < least) least = distance, nearest = candidate;
    }
    return nearest;
}

} // namespace parhelion
