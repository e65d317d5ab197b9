// What `parhelion render --trace` prints.
#pragma once

#include "host/scene/scene.h"
#include "host/twin/sample_trace.h"

#include <nlohmann/json_fwd.hpp>

#include <string>

namespace parhelion {

/// One object: the sample, its vertices, its sum. A number that is not finite is a string.
nlohmann::json trace_json(const Scene& scene, const DeviceScene& flat, const SampleTrace& trace);

/// The same for people, from that object.
std::string trace_text(const nlohmann::json& trace);

} // namespace parhelion
