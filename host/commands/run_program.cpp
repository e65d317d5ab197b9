// A program of command lines: its streams, and errors turned into one line and an exit code.
#include "host/commands/run_program.h"

#include "host/cl/device.h"
#include "host/cl/driver_watch.h"
#include "host/error.h"
#include "host/streams.h"

#include <fmt/format.h>

#include <cerrno>
#include <cstring>
#include <exception>
#include <filesystem>
#include <new>
#include <sstream>

#include <unistd.h>

namespace parhelion {
namespace {

int fail(ExitCode code, const std::string& what) {
    std::istringstream lines(what);
    for (std::string line; std::getline(lines, line);)
        say("parhelion: " + line);
    return static_cast<int>(code);
}

/// Returns only where the program cannot be started.
int become(const std::string& program, const StandardStreams& streams, char** argv) {
    const std::filesystem::path beside =
        std::filesystem::read_symlink("/proc/self/exe").replace_filename(program);
    streams.give_back();
    ::execv(beside.c_str(), argv);
    if (errno != ENOENT)
        return fail(ExitCode::bad_input, fmt::format("{}: {} cannot be started: {}", argv[1],
                                                     beside.string(), std::strerror(errno)));
    return fail(ExitCode::bad_input,
                fmt::format("{}: this subcommand is a program of its own, {}, which is not beside "
                            "this one; cmake --build FOLDER builds it",
                            argv[1], program));
}

int run(const CommandLine& command_line, const StandardStreams& streams, int argc, char** argv) {
    try {
        const int code = run_command_line(command_line, {argv + 1, argv + argc});
        check_printed();
        return code;
    } catch (const RunByOther& other) {
        return become(other.program, streams, argv);
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
                    fmt::format("{} in {}", opencl_error_name(e.err()), e.what()));
    } catch (const std::bad_alloc&) {
        return fail(ExitCode::device_failure, "out of memory" + memory_limit_text());
    } catch (const std::exception& e) {
        return fail(ExitCode::internal_failure, e.what());
    }
}

} // namespace

int run_program(const CommandLine& command_line, int argc, char** argv) {
    const StandardStreams streams;
    report_ends_by_driver();
    return run(command_line, streams, argc, argv);
}

} // namespace parhelion
