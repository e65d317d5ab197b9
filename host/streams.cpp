// The standard streams, any of which may be closed, full, or a pipe that nobody reads.
#include "host/streams.h"

#include "host/error.h"
#include "host/json_text.h"
#include "host/message_log.h"

#include <fcntl.h>
#include <poll.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <string>

namespace parhelion {
namespace {

std::atomic<MessageForm> form_of_messages = MessageForm::text;

/// Writes all of it; 0, or the error's number.
int write_all(int stream, std::string_view text) noexcept {
    while (!text.empty()) {
        const ssize_t written = ::write(stream, text.data(), text.size());
        if (written >= 0) {
            text.remove_prefix(static_cast<std::size_t>(written));
        } else if (errno == EAGAIN) { // a pipe of somebody who does not wait
            pollfd ready{stream, POLLOUT, 0};
            ::poll(&ready, 1, -1);
        } else if (errno != EINTR) {
            return errno;
        }
    }
    return 0;
}

[[noreturn]] void fail(int error) {
    throw OutputError(std::string("standard output: cannot be written: ") + std::strerror(error));
}

} // namespace

StandardStreams::StandardStreams() {
    for (int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO})
        if (::fcntl(stream, F_GETFD) < 0) // the lowest number that is free: this one
            static_cast<void>(::open("/dev/null", O_RDONLY));
    wants_broken_pipe_ignored_ = std::signal(SIGPIPE, SIG_IGN) == SIG_IGN;
    wants_file_limit_ignored_ = std::signal(SIGXFSZ, SIG_IGN) == SIG_IGN;
}

void StandardStreams::end_by_broken_pipe() const {
    if (wants_broken_pipe_ignored_) return;
    std::signal(SIGPIPE, SIG_DFL);
    std::raise(SIGPIPE);
}

void StandardStreams::give_back() const {
    if (!wants_broken_pipe_ignored_) std::signal(SIGPIPE, SIG_DFL);
    if (!wants_file_limit_ignored_) std::signal(SIGXFSZ, SIG_DFL);
}

void print(std::string_view text) {
    const int error = write_all(STDOUT_FILENO, safe_text(text));
    if (error == EPIPE) throw BrokenPipe{};
    if (error != 0) fail(error);
}

void check_printed() {
    const int copy = ::dup(STDOUT_FILENO); // to close any of them says what writing did not
    if (copy >= 0 && ::close(copy) != 0 && errno != EINTR) fail(errno);
}

void tell_messages_as(MessageForm form) noexcept { form_of_messages = form; }
MessageForm message_form() noexcept { return form_of_messages; }

void say(std::string_view text) noexcept {
    const bool json = message_form() == MessageForm::json;
    try {
        const std::string safe = safe_text(text);
        log_message(safe);
        show(json ? json_line(nlohmann::ordered_json{{"state", "note"}, {"message", text}})
                  : safe + '\n');
    } catch (...) { // no memory for a copy
        show(json ? "{\"state\":\"note\",\"message\":\"no memory left for a message\"}\n"
                  : "parhelion: no memory left for a message\n");
    }
}

void pass_on(std::string_view text) noexcept {
    if (text.empty()) return;
    if (message_form() == MessageForm::json) {
        say(text);
    } else {
        log_message(text);
        show(text);
    }
}

void show(std::string_view text) noexcept { static_cast<void>(write_all(STDERR_FILENO, text)); }

} // namespace parhelion
