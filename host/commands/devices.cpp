// `parhelion devices`: what there is to render on, and whether it works.
#include "host/commands/devices.h"

#include "host/cl/no_device.h"
#include "host/cl/self_test.h"
#include "host/cl/work_groups.h"
#include "host/commands/cache_help.h"
#include "host/error.h"
#include "host/json_text.h"
#include "host/streams.h"

#include <fmt/format.h>

#include <memory>
#include <string>

namespace parhelion {
namespace {

struct Tested {
    Device device;
    std::string failure; ///< empty: passed
};

nlohmann::json to_json(const Tested& t) {
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

std::string text_of(const Tested& t) {
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

int run_devices(bool json) {
    DeviceList list = list_devices();
    bool one_works = false;
    nlohmann::json devices = nlohmann::json::array();
    for (const Device& device : list.devices) {
        Tested tested{device, self_test(device)};
        one_works = one_works || tested.failure.empty();
        if (json)
            devices.push_back(to_json(tested));
        else
            print(text_of(tested));
    }
    if (json) print(json_text(nlohmann::json{{"devices", devices}, {"failures", list.failures}}));
    for (const std::string& failure : list.failures)
        say("parhelion: " + failure);
    if (list.devices.empty()) say("parhelion: " + why_no_device(list));
    return static_cast<int>(one_works ? ExitCode::ok : ExitCode::device_failure);
}

} // namespace

Subcommand devices_subcommand() {
    auto json = std::make_shared<bool>(false);
    return {
        .name = "devices",
        .summary = "List OpenCL devices and test each",
        .examples =
            "Example:\n  parhelion devices --json | jq '.devices[].name'" + std::string(cache_help),
        .options = {{"--json", json.get(), "One JSON object"}},
        .run = [json] { return run_devices(*json); },
    };
}

} // namespace parhelion
