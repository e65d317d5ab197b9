// A file that is told what standard error is told, besides.
#include "host/message_log.h"

#include "host/error.h"

#include <fmt/format.h>
#include <spdlog/sinks/basic_file_sink.h>
#include <spdlog/spdlog.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <memory>
#include <sstream>

namespace parhelion {
namespace {

constexpr const char* registered_name = "parhelion messages";

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
        auto log = std::make_shared<spdlog::logger>(
            registered_name, std::make_shared<spdlog::sinks::basic_file_sink_mt>(file));
        log->set_pattern("%Y-%m-%dT%H:%M:%S.%eZ %v", spdlog::pattern_time_type::utc);
        log->flush_on(spdlog::level::trace);
        log->set_error_handler([](const std::string&) {}); // a full disk: nothing depends on it
        spdlog::register_logger(log);
    } catch (const spdlog::spdlog_ex& e) {
        throw InputError(fmt::format("--log {}: {}", file, e.what()));
    }
}

void close_message_log() noexcept {
    try {
        spdlog::drop(registered_name);
    } catch (...) { // a name that could not be copied
    }
}

std::string message_log_file() {
    const auto log = spdlog::get(registered_name);
    if (!log) return "";
    using Sink = spdlog::sinks::basic_file_sink_mt;
    return static_cast<const Sink&>(*log->sinks().front()).filename();
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
