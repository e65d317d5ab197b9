// SIGINT and SIGTERM: what there is of a picture is kept.
#include "host/stop_signals.h"

#include "host/error.h"
#include "host/streams.h"

#include <unistd.h>

#include <array>
#include <atomic>
#include <csignal>
#include <cstdint>
#include <ctime>

namespace parhelion {
namespace {

struct StopSignal {
    int number;
    const char* name;
};
constexpr std::array stop_signals{StopSignal{SIGINT, "SIGINT"}, StopSignal{SIGTERM, "SIGTERM"}};

// A process has one of each signal, and what handles it gets nothing but its number.
std::atomic<bool> noting = false, between = false;
std::atomic<int> noted = 0;
std::atomic<std::int64_t> noted_at = 0; // milliseconds

std::int64_t milliseconds() {
    timespec now{};
    clock_gettime(CLOCK_MONOTONIC, &now);
    return now.tv_sec * 1000 + now.tv_nsec / 1'000'000;
}
static_assert(std::atomic<int>::is_always_lock_free && std::atomic<bool>::is_always_lock_free);

#define NOTHING "stopped by a signal before anything was rendered"
#define BETWEEN "stopped by a signal between two renders; those before are whole"
#define AT_ONCE "stopped at once by a second signal"
#define AS_TEXT(message) "parhelion: " message "\n"
#define AS_JSON(message) "{\"state\":\"note\",\"message\":\"" message "\"}\n"

// Only what a handler may call.
void handle(int number) {
    std::int64_t never = 0; // two threads may be told at the same time
    if (noting && noted_at.compare_exchange_strong(never, milliseconds())) {
        noted = number;
        return;
    }
    // Who sends a signal often sends it twice: to the process and to its group, say.
    if (noting && milliseconds() - noted_at < 1000) return;
    if (message_form() == MessageForm::json)
        show(noting ? AS_JSON(AT_ONCE) : between ? AS_JSON(BETWEEN) : AS_JSON(NOTHING));
    else
        show(noting ? AS_TEXT(AT_ONCE) : between ? AS_TEXT(BETWEEN) : AS_TEXT(NOTHING));
    _exit(static_cast<int>(ExitCode::stopped));
}

void handle_signals() {
    for (const StopSignal& signal : stop_signals) {
        struct sigaction before {};
        sigaction(signal.number, nullptr, &before);
        if (before.sa_handler == SIG_IGN) continue;
        struct sigaction action {};
        action.sa_handler = handle;
        action.sa_flags = SA_RESTART;
        sigaction(signal.number, &action, nullptr);
    }
}

} // namespace

void end_on_signals() {
    noting = between = false, noted = 0, noted_at = 0;
    handle_signals();
}

std::string end_on_signals_again() {
    between = true, noting = false; // what comes from here on ends the process
    return noted_signal();
}

void note_signals() {
    // A compiler in this process (LLVM) puts handlers of its own before these, which let a second
    // signal end it.
    handle_signals();
    noting = true;
}

std::string noted_signal() {
    for (const StopSignal& signal : stop_signals)
        if (signal.number == noted) return signal.name;
    return "";
}

} // namespace parhelion
