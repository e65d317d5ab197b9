// Another process at work beside this one.
#include "host/child_process.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstring>
#include <thread>
#include <utility>

namespace parhelion {
namespace {

/// As exec wants them, which does not change them.
std::vector<char*> pointers(const std::vector<std::string>& texts) {
    std::vector<char*> values;
    values.reserve(texts.size() + 1);
    for (const std::string& text : texts)
        values.push_back(const_cast<char*>(text.c_str()));
    values.push_back(nullptr);
    return values;
}

/// What `more` sets counts; the first of a name does.
std::vector<std::string> environment_with(std::vector<std::string> more) {
    for (char** value = environ; *value; value++)
        more.emplace_back(*value);
    return more;
}

/// In the new process, where only calls that are safe in a signal handler are allowed.
[[noreturn]] void become(pid_t parent, int nothing, int output, char** arguments, char** values) {
    prctl(PR_SET_PDEATHSIG, SIGKILL);
    if (getppid() == parent && dup2(nothing, STDIN_FILENO) >= 0 &&
        dup2(output, STDOUT_FILENO) >= 0 && dup2(output, STDERR_FILENO) >= 0)
        execve(arguments[0], arguments, values);
    _exit(127);
}

/// What a shell says of a program that it cannot start.
constexpr int not_started = 127;

} // namespace

std::optional<ChildProcess> ChildProcess::start(const std::vector<std::string>& arguments,
                                                const std::vector<std::string>& environment) {
    if (access(arguments.front().c_str(), X_OK) != 0) return std::nullopt;
    std::vector<std::string> all_values = environment_with(environment);
    std::vector<char*> words = pointers(arguments), values = pointers(all_values);
    int nothing = open("/dev/null", O_RDWR | O_CLOEXEC);
    int output = memfd_create("output of a child process", MFD_CLOEXEC);
    pid_t parent = getpid();
    pid_t id = nothing >= 0 && output >= 0 ? fork() : -1;
    if (id == 0) become(parent, nothing, output, words.data(), values.data());
    close(nothing);
    if (id > 0) return ChildProcess(id, output);
    close(output);
    return std::nullopt;
}

ChildProcess::ChildProcess(ChildProcess&& other) noexcept
    : id_(std::exchange(other.id_, 0)), output_(std::exchange(other.output_, -1)) {}

ChildProcess& ChildProcess::operator=(ChildProcess&& other) noexcept {
    std::swap(id_, other.id_);
    std::swap(output_, other.output_);
    return *this;
}

ChildProcess::~ChildProcess() {
    wait();
    if (output_ >= 0) close(output_);
}

ChildProcess::End ChildProcess::wait(std::chrono::milliseconds most) {
    if (id_ == 0) return {};
    const auto end = std::chrono::steady_clock::now() + most;
    End result;
    int status = 0;
    rusage usage{};
    pid_t ended = 0;
    while ((ended = wait4(id_, &status, WNOHANG, &usage)) == 0 || (ended < 0 && errno == EINTR)) {
        if (!result.impatient && std::chrono::steady_clock::now() > end) {
            result.impatient = true;
            kill(id_, SIGKILL);
        }
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    id_ = 0;
    if (ended < 0) return result; // somebody else has waited for it
    if (WIFEXITED(status)) result.exit_code = WEXITSTATUS(status);
    if (WIFSIGNALED(status)) result.signal = WTERMSIG(status);
    result.succeeded = result.exit_code == 0;
    result.peak_bytes = static_cast<std::uint64_t>(usage.ru_maxrss) * 1024;
    result.last_line = last_line();
    return result;
}

std::string ChildProcess::last_line() {
    std::string text(4096, '\0');
    const off_t size = lseek(output_, 0, SEEK_END);
    const off_t from = std::max<off_t>(0, size - static_cast<off_t>(text.size()));
    const ssize_t got = pread(output_, text.data(), text.size(), from);
    text.resize(got > 0 ? static_cast<std::size_t>(got) : 0);
    while (text.ends_with('\n'))
        text.pop_back();
    const std::size_t before = text.rfind('\n');
    return before == std::string::npos ? text : text.substr(before + 1);
}

std::string ChildProcess::End::text() const {
    std::string how = impatient ? "took too long and was ended"
                      : signal  ? fmt::format("ended by signal {} ({})", signal, strsignal(signal))
                      : exit_code == not_started ? "could not be started"
                      : exit_code >= 0           ? fmt::format("ended with exit code {}", exit_code)
                                                 : "is gone";
    return last_line.empty() ? how : how + ": " + last_line;
}

} // namespace parhelion
