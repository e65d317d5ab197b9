// The standard streams, any of which may be closed, full, or a pipe that nobody reads: the one
// place that writes to them.
#pragma once

#include <string_view>

namespace parhelion {

/// What the program does with its streams and their signals as long as it lives; made before any
/// file is opened.
class StandardStreams {
public:
    /// Puts something that cannot be written to in the place of closed ones: the next file opened
    /// would stand there, and messages would go into it. A full disk, a file at its limit and a
    /// broken pipe become errors of the write instead of ends of the program.
    StandardStreams();

    /// The end that other programs have where nobody reads their output: by SIGPIPE. Returns where
    /// the caller of this program wants that signal ignored.
    void end_by_broken_pipe() const;

    /// Signals are again what the caller of this program had them to be, for one that takes its
    /// place.
    void give_back() const;

private:
    bool wants_broken_pipe_ignored_;
    bool wants_file_limit_ignored_;
};

/// Nobody reads standard output any more: nothing is left to do.
struct BrokenPipe {};

/// A result, to standard output, at once; fit for a terminal (safe_text). Throws OutputError where
/// it cannot be written, BrokenPipe where nobody reads.
void print(std::string_view text);

/// Throws OutputError where what was printed is lost after all, as on a disk of another machine.
void check_printed();

/// In which form standard error gets messages: lines, or an object of JSON each. The process has
/// one, as it has one standard error.
enum class MessageForm { text, json };
void tell_messages_as(MessageForm form) noexcept;
MessageForm message_form() noexcept;

/// A message, one line or several, to standard error in its form, and to the log of messages
/// (message_log.h); fit for a terminal. One that cannot be written is lost: nothing else depends on
/// it.
void say(std::string_view text) noexcept;

/// What another has written to standard error and was held back: as it is, or as a message.
void pass_on(std::string_view text) noexcept;

/// Text of this program's own for the terminal, as it is, to standard error.
void show(std::string_view text) noexcept;

} // namespace parhelion
