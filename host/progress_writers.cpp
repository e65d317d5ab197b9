// The ways in which progress is told.
#include "host/progress_writers.h"

#include "host/json_text.h"
#include "host/message_log.h"
#include "host/safe_text.h"
#include "host/streams.h"

#include <fmt/format.h>

#include <cmath>

namespace parhelion {
namespace {

using std::chrono::milliseconds;
using State = ProgressEvent::State;

std::string duration_text(double s) {
    if (s < 60.0) return fmt::format("{:.0f} s", s);
    if (s < 3600.0)
        return fmt::format("{:.0f} min {:02.0f} s", std::floor(s / 60.0),
                           s - 60.0 * std::floor(s / 60.0));
    return fmt::format("{:.1f} h", s / 3600.0);
}

/// "3/10 " of the third of ten renders.
std::string part_text(const ProgressEvent& e) {
    return e.parts > 0 ? fmt::format("{}/{} ", e.part, e.parts) : "";
}

std::string phase_text(const ProgressEvent& e) {
    return part_text(e) + (e.subject.empty() ? e.phase : e.phase + " " + e.subject);
}

std::string update_text(const ProgressEvent& e) {
    std::string text = fmt::format("{}: {:.0f} %", phase_text(e), 100.0 * e.fraction);
    if (e.rate) text += fmt::format(", {:.3f} Mpaths/s", *e.rate / 1e6);
    if (auto left = e.seconds_left()) text += fmt::format(", {} left", duration_text(*left));
    return text;
}

/// What a line of text says of it.
std::string text_of(const ProgressEvent& e) {
    switch (e.state) {
    case State::start:
        return phase_text(e) + " ...";
    case State::update:
        return update_text(e);
    case State::finish:
        return fmt::format("{}: {:.2f} s{}{}", phase_text(e), e.seconds,
                           e.message.empty() ? "" : ", ", e.message);
    case State::note:
        break;
    }
    return part_text(e) + e.message;
}

class TerminalWriter : public ProgressWriter {
public:
    TerminalWriter() : ProgressWriter(milliseconds(100)) {}
    void write(const ProgressEvent& e) override {
        const bool last = e.state == State::finish || e.state == State::note;
        const std::string line = as_one_line(text_of(e));
        show(fmt::format("\r{:<{}}{}", line, width_, last ? "\n" : ""));
        width_ = last ? 0 : line.size();
    }

private:
    std::size_t width_ = 0; ///< of the line that stands there
};

class LineWriter : public ProgressWriter {
public:
    explicit LineWriter(void (*put)(const std::string&))
        : ProgressWriter(milliseconds(5000)), put_(put) {}
    void write(const ProgressEvent& e) override {
        if (e.state != State::start) put_(as_one_line(text_of(e)));
    }

private:
    void (*put_)(const std::string&);
};

const char* state_name(State state) {
    switch (state) {
    case State::start:
        return "start";
    case State::update:
        return "update";
    case State::finish:
        return "finish";
    case State::note:
        break;
    }
    return "note";
}

class JsonWriter : public ProgressWriter {
public:
    JsonWriter() : ProgressWriter(milliseconds(500)) {}
    void write(const ProgressEvent& e) override {
        nlohmann::ordered_json json;
        if (!e.phase.empty()) json["phase"] = e.phase;
        json["state"] = state_name(e.state);
        if (e.parts > 0) json["render"] = e.part, json["renders"] = e.parts;
        if (e.state != State::note) {
            json["fraction"] = e.fraction;
            json["seconds"] = e.seconds;
        }
        if (e.rate && std::isfinite(*e.rate)) json["rate"] = *e.rate;
        if (auto left = e.seconds_left()) json["seconds_left"] = *left;
        if (!e.subject.empty()) json["subject"] = e.subject;
        if (!e.message.empty()) json["message"] = e.message;
        show(json_line(json));
    }
};

} // namespace

std::optional<double> ProgressEvent::seconds_left() const {
    if (state != State::update || fraction <= 0.0) return std::nullopt;
    return seconds / fraction - seconds;
}

std::unique_ptr<ProgressWriter> terminal_writer() { return std::make_unique<TerminalWriter>(); }
std::unique_ptr<ProgressWriter> json_writer() { return std::make_unique<JsonWriter>(); }
std::unique_ptr<ProgressWriter> line_writer() {
    return std::make_unique<LineWriter>([](const std::string& line) { show(line + '\n'); });
}
std::unique_ptr<ProgressWriter> log_writer() {
    return std::make_unique<LineWriter>([](const std::string& line) { log_message(line); });
}

} // namespace parhelion
