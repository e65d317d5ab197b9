// What of a scene file can be rendered as it is written: the doctor of scenes.
#pragma once

#include "host/scene/load.h"

#include <nlohmann/json.hpp>

#include <string>

namespace parhelion {

/// Reads the scene as `options` say and, where that is refused, leniently too. {scene, verdict,
/// constructs: [{kind, plugin, exact, approximated, refused}], messages: [{status, construct, text,
/// leniently}]}; the verdict is that of the worst message: "exact" without any. What is no scene
/// file is refused, without constructs.
nlohmann::json check_scene(const std::string& file, const LoadOptions& options);

/// The same for people, a line each.
std::string check_text(const nlohmann::json& check);

/// Of a verdict: ok, different (approximated), bad_input (refused).
ExitCode check_exit_code(const nlohmann::json& check);

} // namespace parhelion
