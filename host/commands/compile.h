// `parhelion compile`: kernels compiled ahead of a render, or beside one.
#pragma once

#include "host/commands/command_line.h"
#include "host/waves/render_device.h"

namespace parhelion {

/// Compiles a program by this subcommand in a process of this program's own. Empty where there is
/// only one processor, or one thread is allowed, to do it.
CompileBeside compile_in_own_process(const Device& device);

Subcommand compile_subcommand();

} // namespace parhelion
