// `parhelion info`: what is in a scene, and what its kernels will have.
#pragma once

#include "host/commands/command_line.h"

namespace parhelion {

/// Its run throws InputError for a scene that cannot be used.
Subcommand info_subcommand();

} // namespace parhelion
