// What a driver may do to the process that calls it, told in one line with an exit code.
#pragma once

#include "host/error.h"

#include <functional>
#include <string>

namespace parhelion {

/// For the program itself, at its start. From then on, what ends the process during watch_driver
/// (the driver's compiler calls exit or abort, or crashes where memory or disk space run out), and
/// a call that does nothing for half a minute, are told as failures of the device: one line on
/// standard error, with the last line that the driver printed, and exit code 3. Without it, as in
/// tests, all of these happen as ever.
void report_ends_by_driver();

/// What the program's own abort() does: where the driver calls it, tells so. (LLVM puts its own
/// handler of SIGABRT in the place of every other, and it does not go on to the one before.)
[[noreturn]] void end_by_abort();

/// Calls the driver: `doing` names it for messages, e.g. "compiling kernels". Memory that runs out
/// is a DeviceError, or ends the process: a driver that was left in the middle holds its locks.
void watch_driver(const std::string& doing, const std::function<void()>& call);

/// " (ulimit -v allows 300 MB)", where there is such a limit.
std::string memory_limit_text();

} // namespace parhelion
