// Another process at work beside this one.
#pragma once

#include <sys/types.h>

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace parhelion {

/// A process that reads nothing and prints nothing. It has ended before this object does.
class ChildProcess {
public:
    /// `arguments`: the program's path, then what it is given. Nothing where it cannot be started.
    static std::optional<ChildProcess> start(const std::vector<std::string>& arguments);

    ChildProcess(ChildProcess&& other) noexcept;
    ChildProcess& operator=(ChildProcess&& other) noexcept;
    ChildProcess(const ChildProcess&) = delete;
    ~ChildProcess();

    struct End {
        bool succeeded = false; ///< exit code 0
        std::uint64_t peak_bytes = 0;
    };
    /// Waits for its end; the first call has the answer.
    End wait();

private:
    explicit ChildProcess(pid_t id) : id_(id) {}

    pid_t id_ = 0; ///< 0: has ended
};

} // namespace parhelion
