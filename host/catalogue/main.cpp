// The program behind `parhelion stress`: a program of its own, so that no other subcommand waits
// for the catalogue to be built.
#include "host/catalogue/run_catalogue.h"
#include "host/cl/driver_watch.h"
#include "host/commands/exit_codes.h"
#include "host/commands/run_program.h"
#include "host/commands/version.h"
#include "host/streams.h"

// Also what libraries call.
extern "C" void abort() noexcept { parhelion::end_by_abort(); }

int main(int argc, char** argv) {
    using namespace parhelion;
    return run_program(
        {
            .summary = "The numerics of Parhelion, tested: started by `parhelion stress`",
            .footer = exit_codes_text(),
            .example = "parhelion stress --list",
            .version = version_text,
            .subcommands = {stress_subcommand(stress::run_catalogue)},
            .print = print,
        },
        argc, argv);
}
