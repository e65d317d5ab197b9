// The program: its subcommands, and errors turned into one line and an exit code.
#include "host/cl/device.h"
#include "host/cl/driver_watch.h"
#include "host/commands/subcommands.h"
#include "host/commands/version.h"
#include "host/error.h"
#include "host/streams.h"

#include <fmt/format.h>

#include <exception>
#include <new>
#include <string>

namespace {

using namespace parhelion;

int fail(ExitCode code, const char* what) {
    say(std::string("parhelion: ") + what);
    return static_cast<int>(code);
}

CommandLine command_line() {
    return {
        .summary = "Parhelion: a physically based renderer for the command line, on OpenCL",
        .footer =
            "Exit codes: 0 done, 1 images differ (compare), a check does not hold (stress) or "
            "a sample was not finite (render --strict), 2 unusable input, 3 device failure or "
            "out of memory, 4 internal failure, 5 a result could not be written (disk full, "
            "standard output "
            "closed, a file of its name made meanwhile).\n"
            "Each subcommand has its own --help with examples.",
        .example = "parhelion render scene.xml -o image.exr",
        .version = version_text,
        .subcommands = all_subcommands(),
        .print = print,
    };
}

} // namespace

// Also what libraries call.
extern "C" void abort() noexcept { parhelion::end_by_abort(); }

int main(int argc, char** argv) {
    const StandardStreams streams;
    report_ends_by_driver();
    try {
        const int code = run_command_line(command_line(), {argv + 1, argv + argc});
        check_printed();
        return code;
    } catch (const BrokenPipe&) {
        streams.end_by_broken_pipe();
        return fail(ExitCode::output_failure, "standard output: nobody reads it");
    } catch (const OutputError& e) {
        return fail(ExitCode::output_failure, e.what());
    } catch (const InputError& e) {
        return fail(ExitCode::bad_input, e.what());
    } catch (const DeviceError& e) {
        return fail(ExitCode::device_failure, e.what());
    } catch (const cl::Error& e) {
        return fail(ExitCode::device_failure,
                    fmt::format("{} in {}", opencl_error_name(e.err()), e.what()).c_str());
    } catch (const std::bad_alloc&) {
        return fail(ExitCode::device_failure, ("out of memory" + memory_limit_text()).c_str());
    } catch (const std::exception& e) {
        return fail(ExitCode::internal_failure, e.what());
    }
}
