// The functions that are fuzzed. Each takes the bytes of one input, returns 0, and throws only if a
// promise is broken.
#pragma once

#include "fuzz_targets.inl" // X(name) for each of the list in CMakeLists.txt

#include <cstddef>
#include <cstdint>

namespace parhelion::fuzz {

using Target = int(const std::uint8_t* data, std::size_t size);

#define DECLARE_TARGET(name) Target fuzz_##name;
FUZZ_TARGETS(DECLARE_TARGET)
#undef DECLARE_TARGET

} // namespace parhelion::fuzz
