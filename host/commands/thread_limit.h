// --threads: how many of the machine's threads the device and the host take.
#pragma once

#include <tbb/global_control.h>

#include <optional>

namespace parhelion {

/// Made before the first OpenCL call: a CPU's driver reads its environment once. 0: all threads.
class ThreadLimit {
public:
    explicit ThreadLimit(int threads);

private:
    std::optional<tbb::global_control> host_;
};

} // namespace parhelion
