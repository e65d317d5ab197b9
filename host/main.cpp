// The program.
#include "host/cl/driver_watch.h"
#include "host/commands/run_program.h"
#include "host/commands/subcommands.h"

// Also what libraries call.
extern "C" void abort() noexcept { parhelion::end_by_abort(); }

int main(int argc, char** argv) {
    return parhelion::run_program(parhelion::program_command_line(), argc, argv);
}
