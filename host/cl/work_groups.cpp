// How many work-items a group may have.
#include "host/cl/work_groups.h"

#include <algorithm>

#include <sys/resource.h>

namespace parhelion {
namespace {

/// A CPU runs the items of a group one after the other in a thread, and what each of them keeps
/// meanwhile lies on the thread's stack: measured (PoCL 3.1, all features, 8 and 16 lanes) 32 to 64
/// KB an item.
std::size_t items_on_a_stack() {
    constexpr std::size_t item_bytes = 64 << 10;
    constexpr std::size_t usual_stack = 2 << 20; // glibc's, where there is no limit
    rlimit stack{};
    bool limited = getrlimit(RLIMIT_STACK, &stack) == 0 && stack.rlim_cur != RLIM_INFINITY;
    return std::max<std::size_t>(1, (limited ? stack.rlim_cur : usual_stack) / item_bytes);
}

} // namespace

std::size_t largest_work_group(const Device& device) {
    std::size_t most = device.handle.getInfo<CL_DEVICE_MAX_WORK_GROUP_SIZE>();
    return device.is_cpu ? std::min(most, items_on_a_stack()) : most;
}

} // namespace parhelion
