// What a stage did and what it cost.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace parhelion {

struct StageReport {
    std::string name;
    double kernel_seconds = 0.0;         ///< on the device, summed over launches
    double longest_launch_seconds = 0.0; ///< likewise, of one
    std::uint64_t launches = 0;
    double compile_seconds = 0.0;
    bool cached = false;
    std::vector<std::string> features; ///< what this stage's kernel was compiled with
};

} // namespace parhelion
