// Samples that were not finite and are left out of the image: where they are and what went wrong.
#pragma once

#include "kernels/device/buffers.h"

#include <array>
#include <vector>

namespace parhelion {

#define FAULT_NAME(name, stage) #name,
inline constexpr std::array fault_names{FAULTS(FAULT_NAME)};
#define FAULT_STAGE(name, stage) #stage,
inline constexpr std::array fault_stages{FAULTS(FAULT_STAGE)};

struct BadSample {
    int x = 0, y = 0; ///< pixel of the full film
    int sample = 0;
    int fault = 0;   ///< enum Fault
    int bounce = -1; ///< vertices before the one where it happened; -1: unknown

    const char* stage() const { return fault_stages[fault]; }
    const char* fault_name() const { return fault_names[fault]; }
};

/// The first ones of all, by sample and then by pixel, no two of them of the same 4x4 block of
/// pixels; at most 16. `of_streams`: BAD_SAMPLE_FIELDS a block, as each stream's accumulate kernel
/// leaves them. The same for any streams.
std::vector<BadSample> first_bad_samples(const std::vector<std::vector<int>>& of_streams);

/// The first ones of several films of one picture, which may know of the same.
std::vector<BadSample> first_of(std::vector<BadSample> all);

} // namespace parhelion
