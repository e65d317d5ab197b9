// What every row of the catalogue is given.
#pragma once

#include "host/catalogue/check.h"
#include "host/numerics/traversal.h"
#include "host/progress.h"
#include "host/waves/render_device.h"

#include <cstdint>
#include <functional>
#include <map>
#include <mutex>
#include <optional>
#include <string>

namespace parhelion::stress {

/// How much is tried. Rows scale their counts by it; what is small is exhausted in any case.
enum class Effort { test, quick, full };

class StressRun {
public:
    StressRun(RenderDevice& d, Effort e, std::uint64_t s, Progress& progress)
        : device(d), effort(e), seed(s), progress_(progress) {}
    /// Keeps its programs for the next run.
    ~StressRun();
    StressRun(const StressRun&) = delete;

    /// A count by effort.
    std::uint64_t count(std::uint64_t test, std::uint64_t quick, std::uint64_t full) const;
    /// That share of the row is done. Any thread may say so.
    void done(double fraction);
    /// The device's program of kernels/stress/<file>.cl, compiled once.
    const Program& program(const std::string& file);
    /// The kernels that trace rays, compiled once; what they trace is the row's.
    Traversal& traversal();

    RenderDevice& device;
    const Effort effort;
    const std::uint64_t seed;

private:
    Progress& progress_;
    std::mutex talking_;
    std::map<std::string, Program> programs_;
    std::optional<Traversal> traversal_;
};

/// A row of the catalogue: checks that are run together.
struct Row {
    std::string name;    ///< for --filter
    std::string chapter; ///< of the report
    std::string title;   ///< what it asks, in a sentence
    std::function<Checks(StressRun&)> run;
};

} // namespace parhelion::stress
