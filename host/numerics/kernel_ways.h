// The ways in which the same kernels can be compiled. All must give the same bits.
#pragma once

#include <fmt/format.h>

#include <string>

namespace parhelion::numerics {

struct KernelWay {
    int lanes;
    bool portable; ///< without x86 intrinsics, of which one lane has none

    std::string name() const {
        return fmt::format("{} lanes{}", lanes, portable ? ", portable" : "");
    }
};

inline constexpr KernelWay kernel_ways[] = {
    {16, false}, {16, true}, {8, false}, {8, true}, {1, false}};

} // namespace parhelion::numerics
