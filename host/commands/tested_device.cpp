// A device with what its self-test has said, as `devices` and `doctor` tell it.
#include "host/commands/tested_device.h"

#include "host/cl/self_test.h"
#include "host/cl/work_groups.h"

#include <fmt/format.h>

namespace parhelion {

TestedDevice tested(const Device& device) { return {device, self_test(device)}; }

nlohmann::json to_json(const TestedDevice& t) {
    const Device& d = t.device;
    return {{"index", d.index},
            {"name", d.name},
            {"vendor", d.vendor},
            {"platform", d.platform},
            {"driver", d.driver_version},
            {"opencl", d.opencl_version},
            {"cpu", d.is_cpu},
            {"compute_units", d.compute_units},
            {"memory_bytes", d.memory_bytes},
            {"largest_buffer_bytes", d.max_allocation_bytes},
            {"float_width", d.float_width},
            {"lanes", d.lanes()},
            {"tracing_lanes", d.tracing_lanes()},
            {"fp64", d.fp64},
            {"correctly_rounded", !d.rounding_option.empty()},
            {"largest_work_group", largest_work_group(d)},
            {"self_test", t.failure.empty() ? "passed" : t.failure}};
}

std::string text_of(const TestedDevice& t) {
    const Device& d = t.device;
    return fmt::format(
        "{}: {}\n   {} ({}), driver {}, {}\n"
        "   {} compute units, {:.1f} GB memory, largest buffer {:.1f} GB, {} floats a vector, {} "
        "lanes, {} rays at once, fp64 {}\n   self-test {}\n",
        d.index, d.name, d.platform, d.vendor, d.driver_version, d.opencl_version, d.compute_units,
        static_cast<double>(d.memory_bytes) / 1e9,
        static_cast<double>(d.max_allocation_bytes) / 1e9, d.float_width, d.lanes(),
        d.tracing_lanes(), d.fp64 ? "yes" : "no",
        t.failure.empty() ? "passed" : "FAILED: " + t.failure);
}

} // namespace parhelion
