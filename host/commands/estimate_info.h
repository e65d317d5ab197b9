// `parhelion info --estimate`: how long a render will take and how much memory, found by beginning
// it.
#pragma once

#include "host/commands/info_text.h"
#include "host/commands/render.h"
#include "host/progress.h"

#include <nlohmann/json_fwd.hpp>

namespace parhelion {

/// Opens the render that the command asks for, and renders for about two seconds. One object; keys
/// that have a unit end in it. `load_seconds`: that reading the scene has taken. Throws InputError
/// and DeviceError as the render would.
nlohmann::json estimate(const RenderCommand& command, const Scene& scene, double load_seconds,
                        Progress& progress);

/// The same for people.
void add_estimate(const nlohmann::json& estimate, InfoText& text);

} // namespace parhelion
