// What can trace rays, so that all are timed by one loop.
#pragma once

#include "host/numerics/ray_states.h"

#include <span>
#include <string>
#include <vector>

namespace parhelion::bench {

using Ray = numerics::TracedRay; ///< Embree is not told which primitive it leaves
/// Of an any-hit query only whether `primitive` is negative means something.
using Hit = numerics::TracedHit;

/// One wave of rays at a time: at most `wave_rays`, which a renderer keeps in its cache.
class Tracer {
public:
    static constexpr std::size_t wave_rays = std::size_t{1} << 16;

    Tracer() = default;
    Tracer(const Tracer&) = delete;
    Tracer& operator=(const Tracer&) = delete;
    virtual ~Tracer() = default;

    virtual std::string name() const = 0;
    /// Lays the rays out as the tracer wants them; not timed.
    virtual void prepare(std::span<const Ray> rays, int depth, bool any_hit) = 0;
    /// Traces what was prepared, once; returns the seconds it took.
    virtual double trace() = 0;
    /// What the last trace() found, in the order of the rays.
    virtual std::vector<Hit> hits() = 0;
};

/// All rays, wave after wave. Fills `found` unless null. Returns the seconds by the wall clock, or
/// the processor's time over all threads: what to look at where others use the machine too.
double trace_all(Tracer& tracer, std::span<const Ray> rays, int depth, bool any_hit,
                 std::vector<Hit>* found = nullptr, bool processor_time = false);

} // namespace parhelion::bench
