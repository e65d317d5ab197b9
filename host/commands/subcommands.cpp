// The list of all subcommands, and the command line of the program.
#include "host/commands/subcommands.h"

#include "host/commands/compare.h"
#include "host/commands/compile.h"
#include "host/commands/completion.h"
#include "host/commands/devices.h"
#include "host/commands/doctor.h"
#include "host/commands/exit_codes.h"
#include "host/commands/info.h"
#include "host/commands/manual.h"
#include "host/commands/merge.h"
#include "host/commands/parameters.h"
#include "host/commands/render.h"
#include "host/commands/run_program.h"
#include "host/commands/stress.h"
#include "host/commands/version.h"
#include "host/streams.h"

namespace parhelion {

std::vector<Subcommand> all_subcommands() {
    const auto run_by_other = [](const StressCommand&) -> int { throw RunByOther{stress_program}; };
    return {render_subcommand(),
            merge_subcommand(),
            compare_subcommand(),
            info_subcommand(),
            compile_subcommand(),
            devices_subcommand(),
            doctor_subcommand(),
            stress_subcommand(run_by_other),
            parameters_subcommand(),
            completion_subcommand(program_command_line),
            manual_subcommand(program_command_line)};
}

CommandLine program_command_line() {
    return {
        .summary = "Parhelion: a physically based renderer for the command line, on OpenCL",
        .footer = exit_codes_text(),
        .example = "parhelion render scene.xml -o image.exr",
        .version = version_text,
        .subcommands = all_subcommands(),
        .print = print,
    };
}

} // namespace parhelion
