// `parhelion devices`: what there is to render on, and whether it works.
#pragma once

namespace CLI { // NOLINT(readability-identifier-naming): the library's name
class App;
}

namespace parhelion {

/// Registers the subcommand; `exit_code` becomes device_failure where no device passes its
/// self-test.
void add_devices_command(CLI::App& app, int& exit_code);

} // namespace parhelion
