// Probes on the device.
#include "host/numerics/probe_kernel.h"

#include <stdexcept>

namespace parhelion::numerics {
namespace {

constexpr int chunk = 256; // PROBE_CHUNK of kernels/stress/probe_kernel.h

} // namespace

Program stress_program(const RenderDevice& device, const std::string& file, const KernelWay& way) {
    return {
        device.context, device.device, device.cache,
        program_source({"stress/" + file + ".cl"}, {.lanes = way.lanes, .portable = way.portable})};
}

ProbeKernel::ProbeKernel(const RenderDevice& device, const Program& program, int count)
    : queue_(device.context, device.device.handle), kernel_(program.kernel("probe")),
      in_(device.context, "probe inputs", std::size_t{PROBE_INPUTS} * count),
      out_(device.context, "probe outputs", std::size_t{PROBE_OUTPUTS} * count), count_(count) {
    if (count % chunk != 0) throw std::logic_error("probes come in whole chunks");
    kernel_.setArg(0, in_.handle());
    kernel_.setArg(1, out_.handle());
    kernel_.setArg(2, count);
}

void ProbeKernel::run(int number, const WordArrays& in, WordArrays& out) {
    in_.write(queue_, in.data());
    kernel_.setArg(3, number);
    queue_.enqueueNDRangeKernel(kernel_, cl::NullRange, cl::NDRange(count_ / chunk),
                                cl::NDRange(1));
    out.resize(out_.count());
    out_.read(queue_, out.data());
}

} // namespace parhelion::numerics
