// The program.
#include "host/cl/driver_watch.h"
#include "host/commands/run_program.h"
#include "host/commands/subcommands.h"
#include "host/commands/version.h"
#include "host/streams.h"

// Also what libraries call.
extern "C" void abort() noexcept { parhelion::end_by_abort(); }

int main(int argc, char** argv) {
    using namespace parhelion;
    return run_program(
        {
            .summary = "Parhelion: a physically based renderer for the command line, on OpenCL",
            .footer = exit_codes_text(),
            .example = "parhelion render scene.xml -o image.exr",
            .version = version_text,
            .subcommands = all_subcommands(),
            .print = print,
        },
        argc, argv);
}
