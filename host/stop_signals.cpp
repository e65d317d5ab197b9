// SIGINT and SIGTERM: what there is of a picture is kept.
#include "host/stop_signals.h"

#include "host/error.h"
#include "host/streams.h"

#include <unistd.h>

#include <array>
#include <atomic>
#include <csignal>

namespace parhelion {
namespace {

struct StopSignal {
    int number;
    const char* name;
};
constexpr std::array stop_signals{StopSignal{SIGINT, "SIGINT"}, StopSignal{SIGTERM, "SIGTERM"}};

// A process has one of each signal, and what handles it gets nothing but its number.
std::atomic<bool> noting = false;
std::atomic<int> noted = 0;
static_assert(std::atomic<int>::is_always_lock_free && std::atomic<bool>::is_always_lock_free);

#define NOTHING "stopped by a signal; nothing was rendered"
#define AT_ONCE "stopped at once by a second signal"
#define AS_TEXT(message) "parhelion: " message "\n"
#define AS_JSON(message) "{\"state\":\"note\",\"message\":\"" message "\"}\n"

// Only what a handler may call.
void handle(int number) {
    int none = 0;
    if (noting && noted.compare_exchange_strong(none, number)) return;
    if (message_form() == MessageForm::json)
        show(noting ? AS_JSON(AT_ONCE) : AS_JSON(NOTHING));
    else
        show(noting ? AS_TEXT(AT_ONCE) : AS_TEXT(NOTHING));
    _exit(static_cast<int>(ExitCode::stopped));
}

} // namespace

void end_on_signals() {
    noting = false, noted = 0;
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

void note_signals() { noting = true; }

std::string noted_signal() {
    for (const StopSignal& signal : stop_signals)
        if (signal.number == noted) return signal.name;
    return "";
}

} // namespace parhelion
