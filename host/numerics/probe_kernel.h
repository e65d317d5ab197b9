// Probes on the device.
#pragma once

#include "host/cl/buffer.h"
#include "host/numerics/kernel_ways.h"
#include "host/numerics/probes.h"
#include "host/waves/render_device.h"

namespace parhelion::numerics {

/// kernels/stress/<file>.cl for a device: a group of probes, or other functions.
Program stress_program(const RenderDevice& device, const std::string& file, const KernelWay& way);

class ProbeKernel {
public:
    /// count: a multiple of 256, the work of one work-item.
    ProbeKernel(const RenderDevice& device, const Program& program, int count);
    void run(int number, const WordArrays& in, WordArrays& out);

private:
    cl::CommandQueue queue_;
    cl::Kernel kernel_;
    Buffer<float> in_, out_;
    int count_;
};

} // namespace parhelion::numerics
