// What the user is told of samples that were not finite.
#pragma once

#include "host/commands/render.h"

#include <string>

namespace parhelion {

/// How many were left out and why, where the first ones are, and the command that tells the first
/// vertex by vertex; several lines. Empty if there are none.
std::string bad_sample_warning(const RenderCommand& command, const RenderReport& report);

} // namespace parhelion
