// Compiling one kernel file, or reading back what was compiled before.
#include "host/cl/program.h"

#include "host/cl/source.h"
#include "host/error.h"

#include <fmt/format.h>

#include <chrono>
#include <sstream>

namespace parhelion {
namespace {

std::string option_text(const ProgramOptions& options) {
    return fmt::format("-cl-std=CL1.2 -DLANES={} -DFEATURE_MASK=0x{:x}ul{}", options.lanes,
                       options.features, options.portable ? " -DPORTABLE" : "");
}

/// The lines of a compiler's log that say what is wrong; one mistake in a header gives hundreds.
std::string first_errors(const std::string& log) {
    constexpr int most = 8;
    std::istringstream lines(log);
    std::string line, errors;
    for (int count = 0; count < most && std::getline(lines, line);) {
        if (line.find("error") == std::string::npos) continue;
        errors += line + "\n";
        count++;
    }
    return errors.empty() ? log : errors;
}

std::string kernel_name(const std::string& file) { return file.substr(0, file.find('.')); }

} // namespace

Program::Program(const cl::Context& context, const Device& device, const ProgramCache& cache,
                 const std::string& file, const ProgramOptions& options)
    : Program(context, device, cache, file, kernel_source(file), options) {}

Program::Program(const cl::Context& context, const Device& device, const ProgramCache& cache,
                 const std::string& file, const std::string& source, const ProgramOptions& options)
    : file_(file), options_(option_text(options)) {
    auto start = std::chrono::steady_clock::now();
    key_ = fmt::format("{}\n{}\n{}\n{}\n{}\n", device.platform, device.name, device.driver_version,
                       device.opencl_version, options_) +
           source;
    if (auto binary = cache.load(key_)) from_cache_ = build_from(context, device, *binary);
    if (!from_cache_) build_source(context, device, source);
    seconds_ = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

bool Program::build_from(const cl::Context& context, const Device& device,
                         const std::vector<unsigned char>& binary) {
    try {
        program_ = cl::Program(context, {device.handle}, {binary});
        program_.build({device.handle});
        kernel(); // a binary without it is of no use
        return true;
    } catch (const cl::Error&) {
        return false; // from another build of the driver, say: the source is at hand
    }
}

void Program::build_source(const cl::Context& context, const Device& device,
                           const std::string& source) {
    program_ = cl::Program(context, source);
    try {
        program_.build({device.handle}, options_.c_str());
    } catch (const cl::Error& e) {
        std::string log = first_errors(program_.getBuildInfo<CL_PROGRAM_BUILD_LOG>(device.handle));
        throw DeviceError(fmt::format("kernel file {} does not compile on {}: {}\n{}", file_,
                                      device.name, opencl_error_name(e.err()), log));
    }
}

cl::Kernel Program::kernel() const { return cl::Kernel(program_, kernel_name(file_).c_str()); }

void Program::store(const ProgramCache& cache) const {
    if (from_cache_) return;
    auto binaries = program_.getInfo<CL_PROGRAM_BINARIES>();
    if (!binaries.empty() && !binaries.front().empty()) cache.store(key_, binaries.front());
}

} // namespace parhelion
