// Another process at work beside this one.
#pragma once

#include <sys/types.h>

#include <chrono>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace parhelion {

/// A process that reads nothing. It has ended before this object does, and where this process ends
/// first (or the thread that started it), the kernel ends it.
class ChildProcess {
public:
    /// `arguments`: the program's path, then what it is given. `environment`: NAME=VALUE, beside
    /// this process's own. Nothing where it cannot be started.
    static std::optional<ChildProcess> start(const std::vector<std::string>& arguments,
                                             const std::vector<std::string>& environment = {});

    ChildProcess(ChildProcess&& other) noexcept;
    ChildProcess& operator=(ChildProcess&& other) noexcept;
    ChildProcess(const ChildProcess&) = delete;
    ~ChildProcess();

    struct End {
        bool succeeded = false; ///< exit code 0
        std::uint64_t peak_bytes = 0;
        int exit_code = -1;      ///< -1: it did not come to an exit
        int signal = 0;          ///< that ended it; 0: none
        bool impatient = false;  ///< it was ended because it took too long
        std::string last_line{}; ///< of what it printed, to either stream

        /// How it ended, for a message: "ended by signal 9 (Killed)".
        std::string text() const;
    };
    /// Waits for its end, or ends it when `most` has passed; the first call has the answer.
    End wait(std::chrono::milliseconds most = std::chrono::hours(1));

private:
    ChildProcess(pid_t id, int output) : id_(id), output_(output) {}
    std::string last_line();

    pid_t id_ = 0;    ///< 0: has ended
    int output_ = -1; ///< what it prints
};

} // namespace parhelion
