// What tells one render from another.
#pragma once

#include <string>
#include <utility>
#include <vector>

namespace parhelion {

/// Part by part: a name for the user ("--seed", "the scene") and the value or the digest of what it
/// stands for.
using RenderKey = std::vector<std::pair<std::string, std::string>>;

/// What differs first, for the user; nothing where the two are the same.
std::string key_difference(const RenderKey& there, const RenderKey& here);

} // namespace parhelion
