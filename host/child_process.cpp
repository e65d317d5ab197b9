// Another process at work beside this one.
#include "host/child_process.h"

#include <fcntl.h>
#include <spawn.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <utility>

namespace parhelion {
namespace {

/// What the child finds as standard input, output and error: nothing.
class NoStreams {
public:
    NoStreams() {
        posix_spawn_file_actions_init(&actions_);
        for (int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO})
            posix_spawn_file_actions_addopen(&actions_, stream, "/dev/null", O_RDWR, 0);
    }
    NoStreams(const NoStreams&) = delete;
    ~NoStreams() { posix_spawn_file_actions_destroy(&actions_); }
    const posix_spawn_file_actions_t* get() const { return &actions_; }

private:
    posix_spawn_file_actions_t actions_{};
};

} // namespace

std::optional<ChildProcess> ChildProcess::start(const std::vector<std::string>& arguments) {
    std::vector<char*> values; // posix_spawn does not change them
    values.reserve(arguments.size() + 1);
    for (const std::string& argument : arguments)
        values.push_back(const_cast<char*>(argument.c_str()));
    values.push_back(nullptr);
    pid_t id = 0;
    if (posix_spawn(&id, values.front(), NoStreams().get(), nullptr, values.data(), environ) != 0)
        return std::nullopt;
    return ChildProcess(id);
}

ChildProcess::ChildProcess(ChildProcess&& other) noexcept : id_(std::exchange(other.id_, 0)) {}

ChildProcess& ChildProcess::operator=(ChildProcess&& other) noexcept {
    std::swap(id_, other.id_);
    return *this;
}

ChildProcess::~ChildProcess() { wait(); }

ChildProcess::End ChildProcess::wait() {
    if (id_ == 0) return {};
    int status = 0;
    rusage usage{};
    pid_t ended = -1;
    do
        ended = wait4(id_, &status, 0, &usage);
    while (ended < 0 && errno == EINTR);
    id_ = 0;
    if (ended < 0) return {}; // somebody else has waited for it
    return {WIFEXITED(status) && WEXITSTATUS(status) == 0,
            static_cast<std::uint64_t>(usage.ru_maxrss) * 1024};
}

} // namespace parhelion
