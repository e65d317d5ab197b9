// A program of command lines: its streams, and errors turned into one line and an exit code.
#pragma once

#include "host/commands/command_line.h"

#include <string>

namespace parhelion {

/// What a subcommand throws that another program runs: `program` lies beside this one, and takes
/// its place with the same arguments.
struct RunByOther {
    std::string program;
};

/// Runs the command line of main(). Returns the exit code.
int run_program(const CommandLine& command_line, int argc, char** argv);

} // namespace parhelion
