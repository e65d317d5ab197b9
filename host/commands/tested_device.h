// A device with what its self-test has said, as `devices` and `doctor` tell it.
#pragma once

#include "host/cl/device.h"

#include <nlohmann/json.hpp>

#include <string>

namespace parhelion {

struct TestedDevice {
    Device device;
    std::string failure; ///< empty: passed
};

TestedDevice tested(const Device& device);

nlohmann::json to_json(const TestedDevice& device);
/// Three lines.
std::string text_of(const TestedDevice& device);

} // namespace parhelion
