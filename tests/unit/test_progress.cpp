// How progress and messages are told: standard error as a file, read again by JSON's own reader.
#include "host/cl/end_line.h"
#include "host/error.h"
#include "host/json_text.h"
#include "host/progress.h"
#include "host/streams.h"

#include <catch2/catch.hpp>

#include <array>
#include <fcntl.h>
#include <sstream>
#include <sys/mman.h>
#include <unistd.h>

using namespace parhelion;

namespace {

/// Standard error is a file as long as this lives.
class StandardError {
public:
    StandardError() : before_(::dup(STDERR_FILENO)), file_(::memfd_create("stderr", 0)) {
        REQUIRE(::dup2(file_, STDERR_FILENO) >= 0);
    }
    ~StandardError() {
        ::dup2(before_, STDERR_FILENO);
        ::close(before_);
        ::close(file_);
    }
    StandardError(const StandardError&) = delete;
    StandardError& operator=(const StandardError&) = delete;

    std::string text() const {
        std::string all(static_cast<std::size_t>(::lseek(file_, 0, SEEK_END)), '\0');
        REQUIRE(::pread(file_, all.data(), all.size(), 0) == static_cast<ssize_t>(all.size()));
        return all;
    }

private:
    int before_, file_;
};

std::string told(Progress::Mode mode, const std::function<void(Progress&)>& tell) {
    const StandardError error;
    Progress progress(mode);
    tell(progress);
    return error.text();
}

std::vector<nlohmann::json> objects(const std::string& text) {
    std::vector<nlohmann::json> all;
    std::istringstream lines(text);
    for (std::string line; std::getline(lines, line);)
        all.push_back(nlohmann::json::parse(line));
    return all;
}

/// Every byte, in pieces that are and are not UTF-8.
std::vector<std::string> evil_texts() {
    std::vector<std::string> texts{"", "\"", "\\", "\\u", "a\nb\r\n\tc", "\xe2\x80\xa8\xc2\x9b"};
    std::string all;
    for (int byte = 0; byte < 256; byte++) {
        all.push_back(static_cast<char>(byte));
        texts.emplace_back(1, static_cast<char>(byte));
    }
    texts.push_back(all);
    return texts;
}

} // namespace

TEST_CASE("Progress: every line of JSON is valid, whatever the text", "[progress]") {
    for (const std::string& text : evil_texts()) {
        const std::string lines = told(Progress::Mode::json, [&](Progress& progress) {
            progress.start("loading", text);
            progress.finish(text);
            progress.note("note: " + text);
        });
        const auto all = objects(lines);
        REQUIRE(all.size() == 3);
        CHECK(all[0]["state"] == "start");
        CHECK(all[1]["fraction"] == 1);
        CHECK(all[2]["message"].get<std::string>().starts_with("note: "));
        // A terminal obeys none of it.
        for (const char c : lines)
            CHECK((c == '\n' || (static_cast<unsigned char>(c) >= 0x20 && c != 0x7f)));
    }
}

TEST_CASE("Progress: JSON tells fraction, rate and the time that is left", "[progress]") {
    const auto all = objects(told(Progress::Mode::json, [](Progress& progress) {
        progress.start("rendering");
        ::usleep(600'000); // updates are told twice a second
        progress.update(0.25, 2e6);
        progress.update(0.26, 2e6);
        progress.finish("2 Mpaths/s");
    }));
    REQUIRE(all.size() == 3);
    const nlohmann::json& update = all[1];
    CHECK(update["phase"] == "rendering");
    CHECK(update["state"] == "update");
    CHECK(update["fraction"] == 0.25);
    CHECK(update["rate"] == 2e6);
    CHECK(update["seconds"].get<double>() >= 0.6);
    // A quarter took so long: three times that is left.
    CHECK(update["seconds_left"].get<double>() ==
          Approx(3 * update["seconds"].get<double>()).epsilon(1e-12));
    CHECK(all[2]["state"] == "finish");
    CHECK(all[2]["message"] == "2 Mpaths/s");
}

TEST_CASE("Progress: lines and terminal say the same in their ways", "[progress]") {
    const auto tell = [](Progress& progress) {
        progress.start("loading", "a\nb.xml");
        progress.finish("1 shape");
        progress.note("note: x");
    };
    CHECK_THAT(told(Progress::Mode::lines, tell),
               Catch::Matches("loading a\\\\nb\\.xml: 0\\.[0-9]+ s, 1 shape\nnote: x\n"));
    CHECK_THAT(
        told(Progress::Mode::terminal, tell),
        Catch::Matches("\rloading a\\\\nb\\.xml \\.\\.\\.\rloading a\\\\nb\\.xml: 0\\.[0-9]+ "
                       "s, 1 shape\n\rnote: x\n"));
    CHECK(told(Progress::Mode::quiet, tell).empty());
}

TEST_CASE("Progress: which of several renders it is, and a note once", "[progress]") {
    const auto tell = [](Progress& progress) {
        progress.note("note: before");
        progress.start_part(3, 10);
        progress.start("loading", "scene.xml");
        progress.finish("done");
        progress.note("note: before");
        progress.note("note: of this one");
        progress.start_part(4, 10);
        progress.note("note: of this one");
    };
    const std::string lines = told(Progress::Mode::lines, tell);
    CHECK(lines.starts_with("note: before\n3/10 loading scene.xml: "));
    CHECK(lines.ends_with(", done\n3/10 note: of this one\n"));
    const std::vector<nlohmann::json> all = objects(told(Progress::Mode::json, tell));
    REQUIRE(all.size() == 4);
    CHECK_FALSE(all[0].contains("render"));
    for (std::size_t i = 1; i < all.size(); i++) {
        CHECK(all[i].at("render") == 3);
        CHECK(all[i].at("renders") == 10);
    }
}

TEST_CASE("Progress: what is asked for, and what contradicts itself", "[progress]") {
    CHECK(Progress::mode_of("json", false) == Progress::Mode::json);
    CHECK(Progress::mode_of("lines", false) == Progress::Mode::lines);
    CHECK(Progress::mode_of("terminal", false) == Progress::Mode::terminal);
    CHECK(Progress::mode_of("auto", true) == Progress::Mode::quiet);
    const StandardError a_file;
    CHECK(Progress::mode_of("auto", false) == Progress::Mode::lines);
    CHECK_THROWS_WITH(Progress::mode_of("json", true), Catch::Contains("--quiet"));
    CHECK_THROWS_WITH(Progress::mode_of("", false),
                      "--progress '': there are auto, json, lines, terminal");
}

TEST_CASE("Messages: as JSON, whatever the text", "[progress]") {
    tell_messages_as(MessageForm::json);
    for (const std::string& text : evil_texts()) {
        const StandardError error;
        say(text);
        pass_on("driver: " + text);
        const auto all = objects(error.text());
        CHECK(all.size() == 2);
        CHECK(all[0]["state"] == "note");
    }
    tell_messages_as(MessageForm::text);
    const StandardError error;
    say("a line");
    CHECK(error.text() == "a line\n");
}

TEST_CASE("Messages: the last line of a handler is valid JSON and fits", "[progress]") {
    for (const std::string& text : evil_texts()) {
        const StandardError error;
        EndLine line;
        line.add("the driver failed: ");
        line.add(text);
        line.add(std::string(10'000, 'x'));
        line.tell({STDERR_FILENO, true, ""});
        const auto all = objects(error.text());
        REQUIRE(all.size() == 1);
        CHECK(all[0]["message"].get<std::string>().starts_with("the driver failed: "));
    }
}
