// What a driver may do to the process that calls it, told in one line with an exit code.
//
// The state is the process's own: handlers of signals and of exit() are given no arguments.
#include "host/cl/driver_watch.h"

#include "host/cl/device.h"
#include "host/cl/end_line.h"
#include "host/cl/open_file.h"
#include "host/cl/opencl.h"
#include "host/message_log.h"
#include "host/streams.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <ctime>
#include <mutex>
#include <new>
#include <system_error>
#include <thread>

namespace parhelion {
namespace {

constexpr std::array crash_signals = {SIGABRT, SIGSEGV, SIGBUS, SIGILL, SIGFPE};
constexpr int patience_seconds = 30;

/// A call of the driver that is going on. While it does, standard error is a file in memory.
struct Call {
    std::string message; ///< made before: a handler cannot make one
    LastPlaces places;
    int printed = -1;
};

std::atomic<bool> reporting = false;
std::atomic<const Call*> current = nullptr;

/// The last lines of what the driver printed, as one. Safe in a signal handler.
void add_printed(const Call& call, EndLine& line) {
    std::array<char, 300> text{};
    const off_t size = lseek(call.printed, 0, SEEK_END);
    const ssize_t got = pread(call.printed, text.data(), text.size(),
                              std::max<off_t>(0, size - static_cast<off_t>(text.size())));
    auto end = text.begin() + std::max<ssize_t>(0, got);
    while (end != text.begin() && end[-1] == '\n')
        --end;
    if (end == text.begin()) return;
    line.add(": ");
    line.add({text.data(), static_cast<std::size_t>(end - text.begin())});
}

/// Safe in a signal handler. The work folder is left to the next run.
[[noreturn]] void end_process(const Call& call, const char* how) {
    EndLine line;
    line.add(call.message);
    line.add(how);
    add_printed(call, line);
    line.tell(call.places);
    _exit(static_cast<int>(ExitCode::device_failure));
}

const char* signal_text(int number) {
    switch (number) {
    case SIGABRT:
        return "it gave up (SIGABRT)";
    case SIGBUS:
        return "it crashed (SIGBUS)";
    case SIGSEGV:
        return "it crashed (SIGSEGV)";
    default:
        return "it crashed";
    }
}

void on_crash(int number) {
    if (const Call* call = current.exchange(nullptr)) end_process(*call, signal_text(number));
    std::signal(number, SIG_DFL); // not the driver's: it happens again, as ever
    if (number == SIGABRT) raise(number);
}

void on_exit() {
    if (const Call* call = current.exchange(nullptr)) end_process(*call, "it gave up");
}

/// Before an exception leaves the driver in the middle, whose locks then stay closed.
void on_no_memory() {
    if (const Call* call = current.exchange(nullptr)) end_process(*call, "out of memory");
    throw std::bad_alloc();
}

double processor_seconds() {
    timespec time{};
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &time);
    return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

/// Ends the process when it has used no processor for half a minute: two locks wait for each other.
/// Where no thread can be had, nobody looks.
class Watchman {
public:
    explicit Watchman(const Call& call) {
        try {
            thread_ = std::thread([this, &call] { watch(call); });
        } catch (const std::system_error&) {
        }
    }
    Watchman(const Watchman&) = delete;
    ~Watchman() {
        {
            std::lock_guard lock(mutex_);
            over_ = true;
        }
        changed_.notify_one();
        if (thread_.joinable()) thread_.join();
    }

private:
    void watch(const Call& call) {
        std::unique_lock lock(mutex_);
        double used = processor_seconds();
        for (int idle = 0; idle < patience_seconds;) {
            if (changed_.wait_for(lock, std::chrono::seconds(1), [&] { return over_; })) return;
            const double now = processor_seconds();
            idle = now - used < 0.002 ? idle + 1 : 0;
            used = now;
        }
        if (current.exchange(nullptr)) end_process(call, "it does nothing any more");
    }

    std::mutex mutex_;
    std::condition_variable changed_;
    bool over_ = false;
    std::thread thread_;
};

/// What the driver prints is held back, and shown afterwards: it may be asked to (POCL_DEBUG).
class HeldOutput {
public:
    HeldOutput()
        : file_(memfd_create("output of the driver", MFD_CLOEXEC)),
          before_(fcntl(STDERR_FILENO, F_DUPFD_CLOEXEC, STDERR_FILENO + 1)) {
        if (file_ && before_) dup2(file_.number(), STDERR_FILENO);
    }
    HeldOutput(const HeldOutput&) = delete;
    ~HeldOutput() {
        if (!file_ || !before_) return;
        dup2(before_.number(), STDERR_FILENO);
        try {
            std::string text(
                static_cast<std::size_t>(std::max<off_t>(0, lseek(file_.number(), 0, SEEK_END))),
                '\0');
            const ssize_t got = pread(file_.number(), text.data(), text.size(), 0);
            text.resize(got > 0 ? static_cast<std::size_t>(got) : 0);
            pass_on(text);
        } catch (const std::bad_alloc&) { // what the driver has printed is lost
        }
    }
    int file() const { return file_.number(); }
    int before() const { return before_ ? before_.number() : STDERR_FILENO; }

private:
    OpenFile file_, before_;
};

/// As long as this lives, the call goes on.
class Going {
public:
    explicit Going(const Call& call) { current = &call; }
    Going(const Going&) = delete;
    ~Going() { current = nullptr; }
};

void call_and_report(const std::string& doing, const std::function<void()>& call) {
    HeldOutput held;
    const Call now{
        fmt::format("parhelion: the OpenCL driver failed while {}{}: ", doing, memory_limit_text()),
        {held.before(), message_form() == MessageForm::json, message_log_file()},
        held.file()};
    Watchman watchman(now);
    Going going(now);
    call();
}

} // namespace

void report_ends_by_driver() {
    for (int number : crash_signals)
        std::signal(number, on_crash);
    std::atexit(on_exit);
    std::set_new_handler(on_no_memory);
    reporting = true;
}

void end_by_abort() {
    if (const Call* call = current.exchange(nullptr)) end_process(*call, signal_text(SIGABRT));
    std::signal(SIGABRT, SIG_DFL);
    raise(SIGABRT);
    _exit(128 + SIGABRT);
}

void watch_driver(const std::string& doing, const std::function<void()>& call) {
    try {
        if (reporting && !current)
            call_and_report(doing, call);
        else
            call();
    } catch (const std::bad_alloc&) {
        throw DeviceError(fmt::format("{}: out of memory{}", doing, memory_limit_text()));
    } catch (const cl::Error& e) {
        throw DeviceError(fmt::format("{}: {} in {}{}", doing, opencl_error_name(e.err()), e.what(),
                                      memory_limit_text()));
    }
}

std::string memory_limit_text() {
    rlimit limit{};
    if (getrlimit(RLIMIT_AS, &limit) != 0 || limit.rlim_cur == RLIM_INFINITY) return {};
    return fmt::format(" (ulimit -v allows {} MB of memory)", limit.rlim_cur >> 20);
}

} // namespace parhelion
