// Compiling kernel files, or reading back what was compiled before.
#pragma once

#include "host/cl/device.h"
#include "host/cl/program_cache.h"

#include <cstdint>
#include <string>

namespace parhelion {

/// How kernel files are specialised. Nothing of a scene's values may enter: kinds only.
struct ProgramOptions {
    int lanes = 1;
    std::uint64_t features = ~std::uint64_t{0}; ///< mask over enum Feature
    bool portable = false;                      ///< without x86 intrinsics
    bool checked = false; ///< accesses ask whether they stay within their buffers; OpenCL C 2.0
};

/// What is compiled, and for what; whatever can change the result is in its key.
struct ProgramSource {
    std::string name; ///< for messages
    std::string text;
    std::string options; ///< of the OpenCL compiler

    std::string key(const Device& device) const;
};

/// From embedded kernel files, e.g. {"shade.cl"}.
ProgramSource program_source(const std::vector<std::string>& files, const ProgramOptions& options);
/// From a text already put together.
ProgramSource program_source(const std::string& name, const std::string& text,
                             const ProgramOptions& options);

class Program {
public:
    /// Takes the program from the cache or compiles it. Throws DeviceError with the compiler's log.
    Program(const cl::Context& context, const Device& device, const ProgramCache& cache,
            const ProgramSource& source);

    cl::Kernel kernel(const std::string& name) const;
    bool from_cache() const { return from_cache_; }
    /// Keeps the compiled program for the next run. Called after its kernels have run once: some
    /// implementations finish compiling only then.
    void store(const ProgramCache& cache) const;

private:
    bool build_from(const cl::Context& context, const Device& device,
                    const std::vector<unsigned char>& binary);
    void build_source(const cl::Context& context, const Device& device,
                      const ProgramSource& source);
    bool build_quickly(const cl::Context& context, const Device& device,
                       const ProgramSource& source);

    std::string key_;
    cl::Program program_;
    bool from_cache_ = false;
};

} // namespace parhelion
