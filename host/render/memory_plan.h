// How a render keeps to the memory that it may take: how large its pool is, and whether its film is
// in memory as a whole or a band at a time.
#pragma once

#include "host/progress.h"
#include "host/waves/work_sizes.h"

#include <cstdint>

namespace parhelion {

/// What is taken for a while beside pool and film: a band of the picture while it is written
/// (ImageRows::band_rows), what threads have by themselves.
inline constexpr std::uint64_t passing_bytes = 80 << 20;

/// Of a device, bytes.
struct DeviceMemory {
    std::uint64_t all = 0, buffer = 0; ///< in all, in one buffer
    bool of_host = false;              ///< a CPU's
};

/// A render, as far as its memory depends on it.
struct MemoryNeed {
    const Scene& scene;
    const AovPlan& aovs;
    DeviceMemory device;
    int lanes = 1;
    WorkSplit split;             ///< with its streams chosen
    std::uint64_t limit = 0;     ///< bytes that host and device may have each; 0: none
    std::uint64_t of_group = 0;  ///< bytes that the process's control group allows; 0: no limit
    bool kernels_loaded = false; ///< of a render before
};

/// Before the scene is made into records. Throws InputError, saying what it needs, where that is
/// more than the limit, or a few rows of the film are more than there is.
void check_memory(const MemoryNeed& need);

/// Once the scene, whose records are so many bytes, and the kernels are there: a pool that is
/// halved until it has room, and a film of which one band at a time is in memory where it is more
/// than fits. Both are noted. For a device that turns out to have less, smaller pools follow
/// (pool_choices). Throws InputError where not even a row of blocks has room.
std::vector<WorkSizes> sizes_in_memory(const MemoryNeed& need, std::uint64_t scene_bytes,
                                       Progress& progress);

} // namespace parhelion
