// One shared function against a higher precision: inputs dense where they are dangerous, the
// device's bits against the host's, the error of the host's against the truth.
#pragma once

#include "host/catalogue/stress_run.h"

#include <functional>
#include <string>
#include <vector>

// Behind all others: the macros of the shared maths are short.
#include "host/numerics/measure.h"
#include "host/numerics/probes.h"

namespace parhelion::stress {

/// An error that is asked for, and how large it may be.
struct Measure {
    std::string name;
    std::string unit;
    double target;
};

/// An error of this value was not asked for at these inputs.
inline constexpr double not_asked = -1;

struct FunctionTest {
    std::string group, probe; ///< what is called: kernels/stress/probes_<group>.h
    std::string name{};       ///< of the row, if not the probe's
    std::vector<Measure> measures{};
    /// Fills the probe's input words.
    std::function<void(Random&, float* words)> draw{};
    /// One error a measure, from the input and output words; no number is the worst of all.
    std::function<void(const float* in, const float* out, double* errors)> judge{};
    std::string axis{}; ///< of the plot
    double axis_low = 0, axis_high = 0;
    std::function<double(const float* in)> place{}; ///< along that axis
    double share = 1;                               ///< of the usual count of samples
};

/// A check a measure, and one of the device's bits.
Checks run_function_test(StressRun& run, const FunctionTest& test);

} // namespace parhelion::stress
