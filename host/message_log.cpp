// A file that is told what standard error is told, besides.
#include "host/message_log.h"

#include "host/error.h"

#include <fmt/format.h>
#include <spdlog/details/log_msg_buffer.h>
#include <spdlog/pattern_formatter.h>
#include <spdlog/sinks/base_sink.h>
#include <spdlog/sinks/basic_file_sink.h>
#include <spdlog/spdlog.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <mutex>
#include <sstream>
#include <vector>

namespace parhelion {
namespace {

constexpr const char* registered_name = "parhelion messages";

/// A file whose lines wait until they are released.
class WaitingSink : public spdlog::sinks::base_sink<std::mutex> {
public:
    explicit WaitingSink(const std::string& file) : name_(file), file_(file) {
        file_.set_formatter(std::make_unique<spdlog::pattern_formatter>(
            "%Y-%m-%dT%H:%M:%S.%eZ %v", spdlog::pattern_time_type::utc));
    }

    void release() {
        std::lock_guard lock(mutex_);
        released_ = true;
        for (const spdlog::details::log_msg_buffer& message : waiting_)
            file_.log(message);
        waiting_.clear();
        file_.flush();
    }

    /// Empty: it waits.
    std::string file() {
        std::lock_guard lock(mutex_);
        return released_ ? name_ : "";
    }

protected:
    void sink_it_(const spdlog::details::log_msg& message) override {
        if (released_)
            file_.log(message);
        else
            waiting_.emplace_back(message);
    }
    void flush_() override {
        if (released_) file_.flush();
    }

private:
    std::string name_;
    spdlog::sinks::basic_file_sink_st file_;
    std::vector<spdlog::details::log_msg_buffer> waiting_;
    bool released_ = false;
};

WaitingSink* sink_of(const std::shared_ptr<spdlog::logger>& log) {
    return log ? static_cast<WaitingSink*>(log->sinks().front().get()) : nullptr;
}

/// An image, a mesh or a scene that was named by mistake: nothing is added to it.
bool is_no_log(const std::string& file) {
    std::array<char, 4096> start{};
    std::ifstream in(file, std::ios::binary);
    in.read(start.data(), start.size());
    const std::string_view text(start.data(), static_cast<std::size_t>(in.gcount()));
    return text.starts_with('<') || text.find('\0') != std::string_view::npos;
}

void check_log(const std::string& file) {
    std::error_code error;
    const auto type = std::filesystem::status(file, error).type();
    if (type != std::filesystem::file_type::not_found &&
        type != std::filesystem::file_type::regular)
        throw InputError(fmt::format("--log {}: is not a regular file", file));
    if (!std::ofstream(file, std::ios::app)) // spdlog would make the folder, too
        throw InputError(fmt::format("--log {}: cannot be opened: {}", file, std::strerror(errno)));
    if (is_no_log(file))
        throw InputError(fmt::format(
            "--log {}: holds something else (accepted: a new file, or one of lines of text)",
            file));
}

} // namespace

void open_message_log(const std::string& file) {
    close_message_log();
    check_log(file);
    try {
        auto log =
            std::make_shared<spdlog::logger>(registered_name, std::make_shared<WaitingSink>(file));
        log->flush_on(spdlog::level::trace);
        log->set_error_handler([](const std::string&) {}); // a full disk: nothing depends on it
        spdlog::register_logger(log);
    } catch (const spdlog::spdlog_ex& e) {
        throw InputError(fmt::format("--log {}: {}", file, e.what()));
    }
}

void release_message_log() {
    const auto log = spdlog::get(registered_name);
    if (WaitingSink* sink = sink_of(log)) sink->release();
}

void close_message_log() noexcept {
    try {
        spdlog::drop(registered_name);
    } catch (...) { // a name that could not be copied
    }
}

std::string message_log_file() {
    const auto log = spdlog::get(registered_name);
    WaitingSink* sink = sink_of(log);
    return sink ? sink->file() : "";
}

void log_message(std::string_view text) noexcept {
    try {
        const auto log = spdlog::get(registered_name);
        if (!log) return;
        std::istringstream lines{std::string(text)};
        for (std::string line; std::getline(lines, line);)
            log->info(spdlog::string_view_t(line));
    } catch (...) { // no memory for a copy
    }
}

} // namespace parhelion
