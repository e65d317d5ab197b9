// Processes beside this one: how they end, and that none outlives its object.
#include "host/child_process.h"

#include <catch2/catch.hpp>
#include <fmt/format.h>
#include <unistd.h>

#include <filesystem>

using namespace parhelion;
namespace fs = std::filesystem;

TEST_CASE("A child process tells how it ended", "[unit]") {
    auto ended = [](const char* script) {
        auto child = ChildProcess::start({"/bin/sh", "-c", script});
        REQUIRE(child);
        return child->wait();
    };
    CHECK(ended("exit 0").succeeded);
    CHECK(ended("exit 0").peak_bytes > 100000);
    CHECK_FALSE(ended("exit 3").succeeded);
    CHECK_FALSE(ended("kill -KILL $$").succeeded);
    CHECK(ended("echo no; echo why >&2; exit 3").text() == "ended with exit code 3: why");
    CHECK(ended("kill -KILL $$").text() == "ended by signal 9 (Killed)");
    CHECK(ended("test -z \"$(cat)\"").succeeded); // nothing to read
    CHECK_FALSE(ChildProcess::start({"/nowhere/no program"}));
}

TEST_CASE("A child process is given more environment, and not waited for without an end",
          "[unit]") {
    auto child = ChildProcess::start({"/bin/sh", "-c", "echo $MORE; exit 1"}, {"MORE=of it"});
    REQUIRE(child);
    CHECK(child->wait().last_line == "of it");
    auto slow = ChildProcess::start({"/bin/sleep", "100"});
    REQUIRE(slow);
    ChildProcess::End end = slow->wait(std::chrono::milliseconds(20));
    CHECK_FALSE(end.succeeded);
    CHECK(end.text() == "took too long and was ended");
}

TEST_CASE("A child process has ended when its object is gone", "[unit]") {
    fs::path file = fs::temp_directory_path() / fmt::format("parhelion-child-{}", getpid());
    std::string script = fmt::format("sleep 0.2; : > '{}'", file.string());
    {
        auto child = ChildProcess::start({"/bin/sh", "-c", script});
        REQUIRE(child);
        ChildProcess moved = std::move(*child);
        child.reset(); // waits for nothing: the process has another object now
        CHECK_FALSE(fs::exists(file));
    }
    CHECK(fs::exists(file));
    fs::remove(file);
}
