// Compiling kernel files, or reading back what was compiled before.
#include "host/cl/program.h"

#include "host/cl/driver_watch.h"
#include "host/cl/source.h"
#include "host/error.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <sstream>

namespace parhelion {
namespace {

std::string option_text(const ProgramOptions& options) {
    return fmt::format("-cl-std={} -DLANES={} {}{}{}", options.checked ? "CL2.0" : "CL1.2",
                       options.lanes, options.features.definitions(),
                       options.portable ? " -DPORTABLE" : "", options.checked ? " -DCHECKED" : "");
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

/// Of a source, as this device takes them.
std::string options_on(const Device& device, const ProgramSource& source) {
    return fmt::format("{} {}", source.options, device.rounding_option);
}

} // namespace

std::string ProgramSource::key(const Device& device) const {
    return fmt::format("{}\n{}\n{}\n{}\n{}\n{}\n{}\n", device.platform, device.name,
                       device.driver_version, device.opencl_version, options_on(device, *this),
                       device.quick_options, use) +
           text;
}

ProgramSource program_source(const std::vector<std::string>& files, const ProgramOptions& options) {
    return program_source(fmt::format("{}", fmt::join(files, " + ")), kernel_source(files),
                          options);
}

ProgramSource program_source(const std::string& name, const std::string& text,
                             const ProgramOptions& options) {
    return {name, text, option_text(options)};
}

Program::Program(const cl::Context& context, const Device& device, const ProgramCache& cache,
                 const ProgramSource& source)
    : key_(source.key(device)) {
    CachedProgram cached = cache.load(key_);
    note_ = cached.note;
    if (device.keeps_programs) {
        build_kept(context, device, source, cached);
        return;
    }
    if (cached.binary) from_cache_ = build_from(context, device, *cached.binary);
    if (!from_cache_) build_source(context, device, source);
}

/// The driver finds in its folder what the cache has, or compiles.
void Program::build_kept(const cl::Context& context, const Device& device,
                         const ProgramSource& source, const CachedProgram& cached) {
    kept_.emplace(key_);
    bool restored = cached.binary && kept_->restore(*cached.binary);
    bool made = kept_->watch([&] { build_source(context, device, source); });
    from_cache_ = restored && !made;
}

bool Program::build_from(const cl::Context& context, const Device& device,
                         const std::vector<unsigned char>& binary) {
    try {
        program_ = cl::Program(context, {device.handle}, {binary});
        program_.build({device.handle});
        std::vector<cl::Kernel> kernels;
        program_.createKernels(&kernels); // a binary without them is of no use
        return !kernels.empty();
    } catch (const cl::Error&) {
        return false; // from another build of the driver, say: the source is at hand
    }
}

bool Program::build_quickly(const cl::Context& context, const Device& device,
                            const ProgramSource& source) {
    if (device.quick_options.empty()) return false;
    try {
        program_ = cl::Program(context, source.text);
        program_.build({device.handle},
                       (options_on(device, source) + " " + device.quick_options).c_str());
        return true;
    } catch (const cl::Error&) {
        return false; // what is wrong with the source shows again without the options
    }
}

void Program::build_source(const cl::Context& context, const Device& device,
                           const ProgramSource& source) {
    if (build_quickly(context, device, source)) return;
    program_ = cl::Program(context, source.text);
    try {
        program_.build({device.handle}, options_on(device, source).c_str());
    } catch (const cl::Error& e) {
        std::string log = first_errors(program_.getBuildInfo<CL_PROGRAM_BUILD_LOG>(device.handle));
        throw DeviceError(fmt::format("kernel file {} does not compile on {}: {}{}\n{}",
                                      source.name, device.name, opencl_error_name(e.err()),
                                      memory_limit_text(), log));
    }
}

cl::Kernel Program::kernel(const std::string& name) const {
    return cl::Kernel(program_, name.c_str());
}

std::vector<unsigned char> Program::binary() const {
    auto binaries = program_.getInfo<CL_PROGRAM_BINARIES>();
    return binaries.empty() ? std::vector<unsigned char>{} : binaries.front();
}

std::string Program::store(const ProgramCache& cache) const {
    if (!kept_ && from_cache_) return {};
    if (kept_ && kept_->is_stored() && cache.contains(key_)) return {};
    std::vector<unsigned char> bytes = kept_ ? kept_->packed() : binary();
    if (bytes.empty()) return {};
    std::string reason = cache.store(key_, bytes);
    if (kept_) kept_->set_stored();
    return reason;
}

} // namespace parhelion
