// Does a device compute what it should?
#include "host/cl/self_test.h"

#include "host/cl/buffer.h"
#include "host/cl/program.h"
#include "host/cl/queue_end.h"

#include <vector>

namespace parhelion {
namespace {

constexpr int count = 1024;

std::string wrong_value(const std::vector<float>& values) {
    for (int i = 0; i < count; i++) {
        float x = static_cast<float>(i);
        if (values[i] != x * x * 0.25f + 1.0f || values[i + count] != x)
            return fmt::format("element {} is wrong: {} and {}", i, values[i], values[i + count]);
    }
    return {};
}

} // namespace

std::string self_test(const Device& device) {
    try {
        cl::Context context(device.handle);
        cl::CommandQueue queue(context, device.handle);
        Program program(context, device, ProgramCache({}),
                        program_source({"self_test.cl"}, {device.lanes()}));
        Buffer<float> out(context, "self_test", 2 * count);
        const QueueEnd end(queue);
        cl::Kernel kernel = program.kernel("self_test");
        kernel.setArg(0, out.handle());
        kernel.setArg(1, count);
        queue.enqueueNDRangeKernel(kernel, cl::NullRange, cl::NDRange(count));
        std::vector<float> values(2 * count);
        out.read(queue, values.data());
        return wrong_value(values);
    } catch (const cl::Error& e) {
        return fmt::format("{} in {}", opencl_error_name(e.err()), e.what());
    } catch (const DeviceError& e) {
        std::string text = e.what();
        return text.substr(0, text.find('\n'));
    }
}

} // namespace parhelion
