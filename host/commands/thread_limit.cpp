// --threads: how many of the machine's threads the device and the host take.
#include "host/commands/thread_limit.h"

#include <cstdlib>
#include <string>

namespace parhelion {

ThreadLimit::ThreadLimit(int threads) {
    if (threads == 0) return;
    setenv("POCL_MAX_PTHREAD_COUNT", std::to_string(threads).c_str(), 1);
    host_.emplace(tbb::global_control::max_allowed_parallelism, threads);
}

} // namespace parhelion
