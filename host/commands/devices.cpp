// `parhelion devices`: what there is to render on, and whether it works.
#include "host/commands/devices.h"

#include "host/cl/no_device.h"
#include "host/commands/cache_help.h"
#include "host/commands/tested_device.h"
#include "host/error.h"
#include "host/json_text.h"
#include "host/streams.h"

#include <memory>
#include <string>

namespace parhelion {
namespace {

int run_devices(bool json) {
    DeviceList list = list_devices();
    bool one_works = false;
    nlohmann::json devices = nlohmann::json::array();
    for (const Device& device : list.devices) {
        const TestedDevice result = tested(device);
        one_works = one_works || result.failure.empty();
        if (json)
            devices.push_back(to_json(result));
        else
            print(text_of(result));
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
