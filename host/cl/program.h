// Compiling one kernel file, or reading back what was compiled before.
#pragma once

#include "host/cl/device.h"
#include "host/cl/program_cache.h"

#include <cstdint>
#include <string>

namespace parhelion {

/// How a kernel file is specialised. Nothing of a scene's values may enter: kinds only.
struct ProgramOptions {
    int lanes = 1;
    std::uint64_t features = ~std::uint64_t{0}; ///< mask over enum Feature
    bool portable = false;                      ///< without x86 intrinsics
};

class Program {
public:
    /// Takes the program from the cache or compiles it. Throws DeviceError with the compiler's log.
    Program(const cl::Context& context, const Device& device, const ProgramCache& cache,
            const std::string& file, const ProgramOptions& options);
    /// The same for a source already put together; `file` names it and its kernel.
    Program(const cl::Context& context, const Device& device, const ProgramCache& cache,
            const std::string& file, const std::string& source, const ProgramOptions& options);

    /// The kernel of the file: "shade.cl" holds kernel `shade`.
    cl::Kernel kernel() const;
    bool from_cache() const { return from_cache_; }
    double seconds() const { return seconds_; }
    /// Keeps the compiled program for the next run. Called after the kernel has run once: some
    /// implementations finish compiling only then.
    void store(const ProgramCache& cache) const;

private:
    bool build_from(const cl::Context& context, const Device& device,
                    const std::vector<unsigned char>& binary);
    void build_source(const cl::Context& context, const Device& device, const std::string& source);

    std::string file_, options_, key_;
    cl::Program program_;
    bool from_cache_ = false;
    double seconds_ = 0.0;
};

} // namespace parhelion
