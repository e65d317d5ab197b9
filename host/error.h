// Errors a user can act on: every one is a single line that says where, what was found, and what is
// accepted.
#pragma once

#include "host/safe_text.h"

#include <stdexcept>
#include <string>
#include <vector>

namespace parhelion {

/// Process exit codes; documented in `parhelion --help` and kept stable for scripts.
enum class ExitCode {
    ok = 0,
    different = 1,
    bad_input = 2,
    device_failure = 3,
    internal_failure = 4,
    output_failure = 5
};

/// A scene, file, or command line that cannot be used. `what()` is one line, without a trailing
/// newline, or one for each thing that is wrong.
class InputError : public std::runtime_error {
public:
    explicit InputError(const std::string& message) : std::runtime_error(as_one_line(message)) {}
    explicit InputError(const std::vector<std::string>& messages)
        : std::runtime_error(as_lines(messages)) {}
};

/// An OpenCL platform, device, compiler or launch that failed. `what()` is one line (a build log
/// may follow on further lines).
class DeviceError : public std::runtime_error {
public:
    using std::runtime_error::runtime_error;
};

/// A result that could not be written where it was asked for: a full disk, a closed standard
/// output. `what()` is one line.
class OutputError : public std::runtime_error {
public:
    explicit OutputError(const std::string& message) : std::runtime_error(as_one_line(message)) {}
};

/// A place in a text file, printed as `file:line`.
struct SourceLocation {
    std::string file;
    int line = 0; ///< 1-based; 0 when the file has no lines (binary) or the value came from the
                  ///< command line

    std::string to_string() const { return line > 0 ? file + ":" + std::to_string(line) : file; }
};

} // namespace parhelion
