// Every float of the domain of every function of one number: device against host, host against
// double.
#include "host/catalogue/rows.h"
#include "host/parallel.h"

#include <tbb/enumerable_thread_specific.h>

#include <array>
#include <atomic>

#include "host/numerics/measure.h"
#include "host/numerics/probe_kernel.h"

namespace parhelion::f32 {
#include "kernels/stress/one_argument.h"
} // namespace parhelion::f32

namespace parhelion::stress {
namespace {

constexpr std::uint32_t chunk = 1024; // CHUNK of kernels/stress/one_argument.cl
constexpr std::uint32_t batch = 1 << 18;

struct Range {
    std::uint32_t first, last; ///< bits; empty where first > last
};

float argument(std::uint32_t bits) { return std::bit_cast<float>(bits); }

/// What is asked of a function: the error of y = f(bits), in this unit, and how large it may be.
struct Accuracy {
    const char* unit;
    double target;
    double (*error)(std::uint32_t bits, float y);
};

// The truths are the C library's doubles, whose error is 1e-9 of what is measured; for small
// arguments, which nearly all floats are, series whose first term left out is below 1e-17.

double sine_of_turns(double turns) {
    double x = 2 * M_PI * turns;
    return x < 0x1p-9 ? x - x * x * x / 6 + x * x * x * x * x / 120 : std::sin(x);
}
double cosine_of_turns(double turns) {
    double x = 2 * M_PI * turns;
    return x < 0x1p-9 ? 1 - x * x / 2 + x * x * x * x / 24 : std::cos(x);
}
double exponential(double x) {
    return x > -0x1p-12 ? 1 + x + x * x / 2 + x * x * x / 6 + x * x * x * x / 24 : std::exp(x);
}
double arc_cosine(double x) {
    return std::fabs(x) < 0x1p-9 ? M_PI / 2 - x - x * x * x / 6 - x * x * x * x * x * 3 / 40
                                 : std::acos(x);
}
/// erfc(y) exp(y^2); beyond 25 by Abramowitz and Stegun 7.1.23.
double scaled_complement(double y) {
    double s = 1 / (2 * y * y);
    return y < 25 ? std::erfc(y) * std::exp(y * y)
                  : 1 / (y * std::sqrt(M_PI)) * (1 - s * (1 - 3 * s * (1 - 5 * s)));
}
/// How far x is off the point that the share t of a Gaussian is below: a step of Newton's, whose
/// own error is the square of that.
double off_quantile(double t, double x) {
    double share = x < 0 ? std::erfc(-x) - 2 * t : 2 * (1 - t) - std::erfc(x);
    return share * std::sqrt(M_PI) / 2 * std::exp(x * x);
}

// By the names in the list; absolute where the result is an angle or a coordinate.

constexpr Accuracy accuracy_of_sine{"", 1.2e-7, [](std::uint32_t bits, float y) {
                                        return std::fabs(double(y) - sine_of_turns(argument(bits)));
                                    }};
constexpr Accuracy accuracy_of_cosine{"", 1.2e-7, [](std::uint32_t bits, float y) {
                                          return std::fabs(double(y) -
                                                           cosine_of_turns(argument(bits)));
                                      }};
constexpr Accuracy accuracy_of_exp_negative{"relative", 2e-7, [](std::uint32_t bits, float y) {
                                                return std::fabs(
                                                    double(y) / exponential(argument(bits)) - 1);
                                            }};
constexpr Accuracy accuracy_of_acos{"radians", 4e-7, [](std::uint32_t bits, float y) {
                                        return std::fabs(double(y) - arc_cosine(argument(bits)));
                                    }};
double relative_error(double found, double truth) {
    return found == truth ? 0 : std::fabs(found / truth - 1);
}
constexpr Accuracy accuracy_of_log_unit{"relative", 3e-7, [](std::uint32_t bits, float y) {
                                            return relative_error(y,
                                                                  std::log(double(argument(bits))));
                                        }};
constexpr Accuracy accuracy_of_log_one_minus{
    "relative", 3e-7, [](std::uint32_t bits, float y) {
        double x = argument(bits);
        return relative_error(y, x < 0x1p-12 ? -x * (1 + x * (1. / 2 + x * (1. / 3 + x / 4)))
                                             : std::log1p(-x));
    }};
constexpr Accuracy accuracy_of_one_minus_exp{
    "relative", 2e-7, [](std::uint32_t bits, float y) {
        double x = argument(bits);
        return relative_error(y, x > -0x1p-12 ? -x * (1 + x * (1. / 2 + x * (1. / 6 + x / 24)))
                                              : -std::expm1(x));
    }};
constexpr Accuracy accuracy_of_scaled_erfc{"relative", 6e-7, [](std::uint32_t bits, float y) {
                                               return relative_error(
                                                   y, scaled_complement(argument(bits)));
                                           }};
constexpr Accuracy accuracy_of_gaussian_quantile{
    "relative", 6e-7, [](std::uint32_t bits, float y) {
        double off = std::fabs(off_quantile(argument(bits), y));
        return off > 0 ? off / std::fabs(double(y)) : 0;
    }};
/// Exact, and so never 1.
constexpr Accuracy accuracy_of_uniform01{
    "", 0, [](std::uint32_t bits, float y) {
        return y < 1 ? std::fabs(double(y) - double(bits >> 8) * 0x1p-24) : double(INFINITY);
    }};

struct OneArgument {
    std::string name;
    f32::Real (*function)(f32::Uint);
    std::array<Range, 2> ranges;
    std::uint32_t step; ///< from one argument to the next
    Accuracy accuracy;
};

std::vector<OneArgument> functions() {
#define LIST_FUNCTION(name, first, last, first2, last2, step)                                      \
    {#name, f32::one_##name, {{{first, last}, {first2, last2}}}, step, accuracy_of_##name},
    return {ONE_ARGUMENT_FUNCTIONS(LIST_FUNCTION)};
}

struct Finding {
    double worst = 0;
    std::uint32_t worst_bits = 0;
    std::uint64_t differing = 0, tried = 0;
};

void merge(Finding& to, const Finding& from) {
    if (!(from.worst <= to.worst)) to.worst = from.worst, to.worst_bits = from.worst_bits;
    to.differing += from.differing, to.tried += from.tried;
}

struct Worker {
    cl::CommandQueue queue;
    cl::Kernel kernel;
    Buffer<float> out;
    std::vector<float> values = std::vector<float>(batch);
    Worker(const RenderDevice& d, const Program& program)
        : queue(d.context, d.device.handle), kernel(program.kernel("one_argument")),
          out(d.context, "one_argument", batch) {
        kernel.setArg(0, out.handle());
    }

    void run(std::uint32_t first, std::uint32_t step, int which) {
        kernel.setArg(1, cl_uint{first});
        kernel.setArg(2, cl_uint{step});
        kernel.setArg(3, which);
        queue.enqueueNDRangeKernel(kernel, cl::NullRange, cl::NDRange(batch / chunk),
                                   cl::NDRange(1));
        out.read(queue, values.data());
    }
};

/// The arguments of a range from `first` on that fit into a batch.
Finding try_batch(Worker& w, const OneArgument& f, int which, std::uint32_t first,
                  std::uint32_t last) {
    w.run(first, f.step, which);
    Finding found;
    for (std::uint32_t i = 0; i < batch && i <= (last - first) / f.step; i++) {
        std::uint32_t bits = first + i * f.step;
        float host = f.function(bits);
        found.tried++;
        double error = f.accuracy.error(bits, host);
        if (!same_bits(host, w.values[i])) {
            found.differing++;
            error = std::max(error, f.accuracy.error(bits, w.values[i]));
        }
        if (!(error <= found.worst)) found.worst = error, found.worst_bits = bits;
    }
    return found;
}

/// Whether a batch of arguments is tried: all of them but in a quick run, which takes some of those
/// below 2^-32. There functions are as good as straight, and denormal numbers make them slow.
bool tried(Effort effort, const OneArgument& f, std::uint32_t first, std::size_t number) {
    if (effort == Effort::full) return true;
    bool small = f.step == 1 && std::fabs(argument(first)) < 0x1p-32f;
    return number % (effort == Effort::brief ? 256 : small ? 32 : 1) == 0;
}

/// Batches of both ranges.
Finding try_all(StressRun& run, const OneArgument& f, int which) {
    const Program& program = run.program("one_argument");
    tbb::enumerable_thread_specific<Worker> workers([&] { return Worker(run.device, program); });
    Finding all;
    for (Range range : f.ranges) {
        if (range.first > range.last) continue;
        std::size_t batches = (range.last - range.first) / f.step / batch + 1;
        std::vector<Finding> found(batches);
        std::atomic<std::size_t> finished = 0;
        parallel_for(batches, [&](std::size_t i) {
            auto first = range.first + static_cast<std::uint32_t>(i) * batch * f.step;
            if (i + 1 == batches || tried(run.effort, f, first, i))
                found[i] = try_batch(workers.local(), f, which, first, range.last);
            run.done(static_cast<double>(++finished) / static_cast<double>(batches));
        });
        for (const Finding& part : found)
            merge(all, part);
    }
    return all;
}

} // namespace

Checks row_one_argument(StressRun& run) {
    Checks checks;
    std::vector<OneArgument> list = functions();
    for (std::size_t i = 0; i < list.size(); i++) {
        const Accuracy& a = list[i].accuracy;
        Finding f = try_all(run, list[i], static_cast<int>(i));
        checks.push_back({.name = list[i].name + ": largest error",
                          .value = f.worst,
                          .target = a.target,
                          .unit = a.unit,
                          .samples = f.tried,
                          .worst_at = fmt::format("{:.9g}", argument(f.worst_bits))});
        checks.push_back({.name = list[i].name + ": bits that differ between host and device",
                          .value = static_cast<double>(f.differing),
                          .target = 0,
                          .unit = "inputs",
                          .samples = f.tried});
    }
    return checks;
}

} // namespace parhelion::stress
