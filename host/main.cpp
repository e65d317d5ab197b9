// The program: its subcommands, and errors turned into one line and an exit code.
#include "host/commands/compare.h"
#include "host/commands/devices.h"
#include "host/commands/info.h"
#include "host/commands/render.h"
#include "host/commands/version.h"
#include "host/error.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <cstdio>
#include <exception>

namespace {

using namespace parhelion;

int fail(ExitCode code, const char* what) {
    fmt::print(stderr, "parhelion: {}\n", what);
    return static_cast<int>(code);
}

int run(int argc, char** argv) {
    CLI::App app{"Parhelion: a physically based renderer for the command line, on OpenCL"};
    app.require_subcommand(1);
    app.set_version_flag("--version", version_text);
    app.footer("Exit codes: 0 done, 1 images differ (compare), 2 unusable input, 3 device failure, "
               "4 internal failure.\n"
               "Each subcommand has its own --help with examples.");
    int exit_code = 0;
    add_render_command(app);
    add_compare_command(app, exit_code);
    add_info_command(app);
    add_devices_command(app, exit_code);
    try {
        app.parse(argc, argv);
    } catch (const CLI::ParseError& e) {
        if (e.get_exit_code() == 0) return app.exit(e);
        return fail(ExitCode::bad_input, e.what());
    }
    return exit_code;
}

} // namespace

int main(int argc, char** argv) {
    try {
        return run(argc, argv);
    } catch (const InputError& e) {
        return fail(ExitCode::bad_input, e.what());
    } catch (const DeviceError& e) {
        return fail(ExitCode::device_failure, e.what());
    } catch (const std::exception& e) {
        return fail(ExitCode::internal_failure, e.what());
    }
}
