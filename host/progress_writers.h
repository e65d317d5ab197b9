// The ways in which progress is told: what there is to tell, and a class for each.
#pragma once

#include <chrono>
#include <memory>
#include <optional>
#include <string>

namespace parhelion {

/// Something that is worth telling of a long piece of work.
struct ProgressEvent {
    enum class State { start, update, finish, note };

    State state = State::note;
    int part = 0, parts = 0;      ///< which of several renders; 0: there is one
    std::string phase{};          ///< "loading"; of a note: none
    std::string subject{};        ///< "scene.xml"; may be empty
    std::string message{};        ///< a note, or a closing remark
    double fraction = 0;          ///< of the phase, in [0, 1]
    double seconds = 0;           ///< since its start
    std::optional<double> rate{}; ///< paths a second

    std::optional<double> seconds_left() const;
};

class ProgressWriter {
public:
    explicit ProgressWriter(std::chrono::milliseconds interval) : interval_(interval) {}
    virtual ~ProgressWriter() = default;
    ProgressWriter(const ProgressWriter&) = delete;
    ProgressWriter& operator=(const ProgressWriter&) = delete;

    virtual void write(const ProgressEvent& event) = 0;
    /// Updates are not told more often than that.
    std::chrono::milliseconds interval() const { return interval_; }

private:
    std::chrono::milliseconds interval_;
};

/// One line of standard error, rewritten.
std::unique_ptr<ProgressWriter> terminal_writer();
/// Plain lines on standard error.
std::unique_ptr<ProgressWriter> line_writer();
/// Objects of JSON on standard error, one a line.
std::unique_ptr<ProgressWriter> json_writer();
/// Plain lines for the log of messages (message_log.h), where there is one.
std::unique_ptr<ProgressWriter> log_writer();

} // namespace parhelion
