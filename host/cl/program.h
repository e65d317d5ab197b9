// Compiling kernel files, or reading back what was compiled before.
#pragma once

#include "host/cl/device.h"
#include "host/cl/driver_programs.h"
#include "host/cl/program_cache.h"
#include "host/cl/program_options.h"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace parhelion {

/// What is compiled, and for what; whatever can change the result is in its key.
struct ProgramSource {
    std::string name; ///< for messages
    std::string text;
    std::string options; ///< of the OpenCL compiler
    std::string use{};   ///< what a driver compiles for that is not in the text or the options

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
    /// Keeps the compiled program for the next run, where there is more to keep than was found.
    /// Called after its kernels have run once: some implementations finish compiling only then.
    /// Returns nothing, or one line that says why it is not kept.
    std::string store(const ProgramCache& cache) const;
    /// What the user may want to know of the cache, or nothing.
    const std::string& note() const { return note_; }

private:
    bool build_from(const cl::Context& context, const Device& device,
                    const std::vector<unsigned char>& binary);
    void build_source(const cl::Context& context, const Device& device,
                      const ProgramSource& source);
    bool build_quickly(const cl::Context& context, const Device& device,
                       const ProgramSource& source);
    void build_kept(const cl::Context& context, const Device& device, const ProgramSource& source,
                    const CachedProgram& cached);
    std::vector<unsigned char> binary() const;

    std::string key_, note_;
    cl::Program program_;
    bool from_cache_ = false;
    std::optional<DriverProgram> kept_; ///< where the driver keeps programs itself
};

} // namespace parhelion
