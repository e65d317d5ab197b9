// The program: its subcommands, and errors turned into one line and an exit code.
#include "host/commands/subcommands.h"
#include "host/commands/version.h"
#include "host/error.h"

#include <fmt/format.h>

#include <cstdio>
#include <exception>

namespace {

using namespace parhelion;

int fail(ExitCode code, const char* what) {
    fmt::print(stderr, "parhelion: {}\n", what);
    return static_cast<int>(code);
}

CommandLine command_line() {
    return {
        .summary = "Parhelion: a physically based renderer for the command line, on OpenCL",
        .footer =
            "Exit codes: 0 done, 1 images differ (compare), a check does not hold (stress) or "
            "a sample was not finite (render --strict), 2 unusable input, 3 device failure, "
            "4 internal failure.\n"
            "Each subcommand has its own --help with examples.",
        .version = version_text,
        .subcommands = all_subcommands(),
    };
}

} // namespace

int main(int argc, char** argv) {
    try {
        return run_command_line(command_line(), {argv + 1, argv + argc});
    } catch (const InputError& e) {
        return fail(ExitCode::bad_input, e.what());
    } catch (const DeviceError& e) {
        return fail(ExitCode::device_failure, e.what());
    } catch (const std::exception& e) {
        return fail(ExitCode::internal_failure, e.what());
    }
}
