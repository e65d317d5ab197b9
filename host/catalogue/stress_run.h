// What every row of the catalogue is given.
#pragma once

#include "host/catalogue/check.h"
#include "host/numerics/kernel_ways.h"
#include "host/progress.h"

#include <cstdint>
#include <functional>
#include <memory>
#include <string>

namespace parhelion {
class Program;
struct RenderDevice;
namespace numerics {
class Traversal;
}
} // namespace parhelion

namespace parhelion::stress {

using numerics::Traversal;

/// How much is tried. Rows scale their counts by it; what is small is exhausted in any case.
enum class Effort { brief, quick, full };

class StressRun {
public:
    StressRun(RenderDevice& d, const KernelWay& k, Effort e, std::uint64_t s, Progress& progress);
    /// Keeps its programs for the next run.
    ~StressRun();
    StressRun(const StressRun&) = delete;

    /// A count by effort.
    std::uint64_t count(std::uint64_t brief, std::uint64_t quick, std::uint64_t full) const;
    /// Whether the kernels are those that suit the device: what no kernel has a say in is asked
    /// with them alone.
    bool usual_kernels() const;
    /// That share of the row is done. Any thread may say so.
    void done(double fraction);
    /// The device's program of kernels/stress/<file>.cl, compiled once.
    const Program& program(const std::string& file);
    /// The kernels that trace rays, compiled once; what they trace is the row's.
    Traversal& traversal();

    RenderDevice& device;
    const KernelWay kernels; ///< of all that the row does not compile in other ways itself
    const Effort effort;
    const std::uint64_t seed;

private:
    struct Kept;
    std::unique_ptr<Kept> kept_;
};

/// Whether tests ask a row once, or once a way to compile kernels.
enum class Ways { one, every };

/// A row of the catalogue: checks that are run together.
struct Row {
    std::string name;    ///< for --filter
    std::string chapter; ///< of the report
    std::string title;   ///< what it asks, in a sentence
    Ways ways = Ways::one;
    std::function<Checks(StressRun&)> run;
};

} // namespace parhelion::stress
