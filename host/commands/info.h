// `parhelion info`: what is in a scene, and what its kernels will have.
#pragma once

namespace CLI { // NOLINT(readability-identifier-naming): the library's name
class App;
}

namespace parhelion {

/// Registers the subcommand; InputError passes through CLI::App::parse to the caller.
void add_info_command(CLI::App& app);

} // namespace parhelion
