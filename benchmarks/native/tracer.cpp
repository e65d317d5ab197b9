// Any number of rays through a tracer, in waves.
#include "benchmarks/native/tracer.h"

#include <algorithm>
#include <ctime>

namespace parhelion::bench {

static double processor_seconds() {
    timespec t{};
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
    return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

double trace_all(Tracer& tracer, std::span<const Ray> rays, int depth, bool any_hit,
                 std::vector<Hit>* found, bool processor_time) {
    double seconds = 0;
    if (found) found->clear();
    for (std::size_t first = 0; first < rays.size(); first += Tracer::wave_rays) {
        std::span<const Ray> wave =
            rays.subspan(first, std::min(Tracer::wave_rays, rays.size() - first));
        tracer.prepare(wave, depth, any_hit);
        double start = processor_seconds(), wall = tracer.trace();
        seconds += processor_time ? processor_seconds() - start : wall;
        if (!found) continue;
        std::vector<Hit> hits = tracer.hits();
        found->insert(found->end(), hits.begin(), hits.end());
    }
    return seconds;
}

} // namespace parhelion::bench
