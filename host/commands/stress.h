// `parhelion stress`: how accurate this build is on this machine's device.
#pragma once

#include "host/commands/command_line.h"

#include <functional>
#include <optional>
#include <string>

namespace parhelion {

struct StressCommand {
    bool brief = false, quick = false, full = false, list = false, quiet = false, force = false;
    int lanes = 0; ///< 0: what suits the device
    bool portable = false;
    std::string filter, report_folder, json_file, device;
    std::optional<std::uint32_t> seed;
};

/// The program that runs it, beside this one.
inline constexpr const char* stress_program = "parhelion-stress";

Subcommand stress_subcommand(std::function<int(const StressCommand&)> run);

} // namespace parhelion
