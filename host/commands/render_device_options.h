// The device of a command line, and what it says of how to render there.
#pragma once

#include "host/commands/render.h"
#include "host/waves/render_device.h"

namespace parhelion {

/// What is asked for, with the memory that control groups allow and the folder for what has none.
/// Throws InputError.
RenderOptions options_of(const RenderCommand& command);

/// Opened for the rest of the process, to compile as the machine and --memory allow.
RenderDevice& open_device_of(const RenderCommand& command);

} // namespace parhelion
