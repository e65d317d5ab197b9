// Errors a user can act on: every one is a single line that says where, what was found, and what is
// accepted.
#pragma once

#include "host/safe_text.h"

#include <array>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace parhelion {

/// Process exit codes, kept stable for scripts: X(name, number, meaning). What --help, README and
/// the manual say of them is made from this list.
#define EXIT_CODES(X)                                                                              \
    X(ok, 0, "done")                                                                               \
    X(different, 1,                                                                                \
      "images differ (compare), a check does not hold (stress), a sample or a written value was "  \
      "not finite or did not fit the file's format (render --strict), or something is "            \
      "approximated (info --check)")                                                               \
    X(bad_input, 2,                                                                                \
      "unusable input: a line for each problem says where and what is accepted; nothing is "       \
      "written, of several renders nothing but those before")                                      \
    X(device_failure, 3, "device failure, or out of memory")                                       \
    X(internal_failure, 4, "internal failure")                                                     \
    X(output_failure, 5,                                                                           \
      "a result could not be written: disk full, standard output closed, or a file of its name "   \
      "was made meanwhile (the image is kept under the name that is told)")                        \
    X(stopped, 99,                                                                                 \
      "stopped by a signal or by --time-limit; what there is of the image is written: go on with " \
      "--resume, with several renders with --skip-existing")

enum class ExitCode {
#define X(name, number, meaning) name = number,
    EXIT_CODES(X)
#undef X
};

struct ExitCodeMeaning {
    ExitCode code;
    std::string_view meaning;
};

#define X(name, number, meaning) ExitCodeMeaning{ExitCode::name, meaning},
inline constexpr std::array exit_code_meanings{EXIT_CODES(X)};
#undef X

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
