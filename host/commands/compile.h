// `parhelion compile`: kernels compiled ahead of a render, or beside one.
#pragma once

#include "host/commands/command_line.h"
#include "host/waves/render_device.h"

namespace parhelion {

/// Whether there are several processors, and threads allowed, to compile side by side.
bool several_threads();

/// Compiles a program by this subcommand in a process of this program's own.
CompileBeside compile_in_own_process(const Device& device);

Subcommand compile_subcommand();

} // namespace parhelion
