// The program behind `parhelion stress`: a program of its own, so that no other subcommand waits
// for the catalogue to be built.
#include "host/catalogue/run_catalogue.h"
#include "host/cl/driver_watch.h"
#include "host/commands/exit_codes.h"
#include "host/commands/manual.h"
#include "host/commands/run_program.h"
#include "host/commands/version.h"
#include "host/streams.h"

// Also what libraries call.
extern "C" void abort() noexcept { parhelion::end_by_abort(); }

namespace parhelion {
namespace {

CommandLine stress_command_line() {
    return {
        .program = stress_program,
        .summary = "Parhelion: the numerics of the renderer, tested; started by `parhelion stress`",
        .footer = exit_codes_text(),
        .example = "parhelion stress --list",
        .version = version_text,
        .subcommands = {stress_subcommand(stress::run_catalogue),
                        manual_subcommand(stress_command_line, stress_program)},
        .print = print,
    };
}

} // namespace
} // namespace parhelion

int main(int argc, char** argv) {
    return parhelion::run_program(parhelion::stress_command_line(), argc, argv);
}
