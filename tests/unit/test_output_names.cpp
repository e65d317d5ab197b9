// Names of outputs: links, files that appear meanwhile, unfinished files, and two that are one.
#include "host/image/distinct_files.h"
#include "host/image/output.h"
#include "test_image_tools.h"

#include <csignal>
#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <sys/wait.h>

using namespace parhelion;
using namespace image_test;

namespace {

const std::vector<char> old_content{'o', 'l', 'd'}, new_content{'n', 'e', 'w'};

void write(PendingFile& file) { write_bytes(file.temporary_name(), new_content); }

} // namespace

TEST_CASE("Output: a symbolic link stays, and what it leads to is written") {
    const TemporaryFolder folder, elsewhere;
    const std::string target = elsewhere.file("target.txt"), link = folder.file("link.txt"),
                      second = folder.file("second.txt");
    fs::create_symlink(target, link);
    fs::create_symlink("link.txt", second); // relative, to a link
    // To nothing: as little of its name is here as of a file that exists.
    CHECK_THAT(refusal([&] { check_output_file(second, false); }), Catch::Contains("--force"));
    CHECK_NOTHROW(check_output_file(second, true));
    for (const std::string& name : {second, link}) {
        write_text_file(name, "new", Existing::replace);
        CHECK(fs::is_symlink(link));
        CHECK(fs::is_symlink(second));
        CHECK(fs::is_regular_file(fs::symlink_status(target)));
        CHECK(read_bytes(target) == new_content);
        write_bytes(target, old_content);
    }
    CHECK_THAT(refusal([&] { check_output_file(second, false); }), Catch::Contains("exists"));
    CHECK(folder.entries() == 2);
    CHECK(elsewhere.entries() == 1);
    fs::remove_all(elsewhere.name());
    CHECK_THAT(refusal([&] { check_output_file(link, true); }), Catch::Contains("does not exist"));
    fs::create_directories(elsewhere.name());
    const std::string ring = folder.file("ring");
    fs::create_symlink("ring", ring);
    refusal([&] { check_output_file(ring, true); });
}

TEST_CASE("Output: what is no file is refused, forced or not, by whatever name") {
    const TemporaryFolder folder;
    const std::string pipe = folder.file("pipe"), link = folder.file("link");
    REQUIRE(::mkfifo(pipe.c_str(), 0600) == 0);
    fs::create_symlink("pipe", link);
    for (const std::string& name :
         {pipe, link, folder.name(), std::string("/dev/null"), std::string("/dev/full")})
        for (const bool force : {false, true})
            CHECK_THAT(refusal([&] { check_output_file(name, force); }),
                       Catch::Contains("not a regular file"));
    int ends[2];
    REQUIRE(::pipe(ends) == 0); // what /dev/stdout leads to has no name
    CHECK_THAT(
        refusal([&] { check_output_file("/proc/self/fd/" + std::to_string(ends[1]), true); }),
        Catch::Contains("not a regular file"));
    ::close(ends[0]);
    ::close(ends[1]);
    CHECK_THAT(refusal([&] { check_output_file("-", true); }), Catch::Contains("standard output"));
}

TEST_CASE("Output: a file that appears meanwhile is kept, and so is the new one") {
    const TemporaryFolder folder;
    const std::string name = folder.file("a.exr");
    for (const std::string kept : {"a.1.exr", "a.2.exr"}) {
        PendingFile pending(name, Existing::keep);
        write(pending);
        write_bytes(name, old_content);
        CHECK_THAT(refusal<OutputError>([&] { pending.commit(); }),
                   Catch::Contains("has appeared") && Catch::Contains(folder.file(kept)));
        CHECK(read_bytes(name) == old_content);
        CHECK(read_bytes(folder.file(kept)) == new_content);
    }
    {
        PendingFile pending(name, Existing::replace);
        write(pending);
        pending.commit();
    }
    CHECK(read_bytes(name) == new_content);
    CHECK(folder.entries() == 3);
}

TEST_CASE("Output: a finished file whose name cannot be had is kept under another") {
    const TemporaryFolder folder;
    for (const Existing existing : {Existing::keep, Existing::replace}) {
        const TemporaryFolder folder;
        PendingFile pending(folder.file("a.exr"), existing);
        write(pending);
        fs::create_directory(folder.file("a.exr"));
        CHECK_THAT(refusal<OutputError>([&] { pending.commit(); }),
                   Catch::Contains(folder.file("a.1.exr")));
        CHECK(read_bytes(folder.file("a.1.exr")) == new_content);
        CHECK(folder.entries() == 2);
    }
}

TEST_CASE("Output: nothing stays of a file whose writer is killed") {
    const TemporaryFolder folder;
    const std::string name = folder.file("a.exr");
    for (int round = 0; round < 3; ++round) {
        int ready[2];
        REQUIRE(::pipe(ready) == 0);
        const pid_t writer = ::fork();
        if (writer == 0) {
            const PendingFile pending(name, Existing::keep);
            static_cast<void>(!::write(ready[1], "x", 1));
            ::pause();
        }
        char byte = 0;
        REQUIRE(::read(ready[0], &byte, 1) == 1);
        REQUIRE(::kill(writer, SIGKILL) == 0);
        REQUIRE(::waitpid(writer, nullptr, 0) == writer);
        ::close(ready[0]);
        ::close(ready[1]);
    }
    { const PendingFile next(name, Existing::keep); } // where files need a name, this one clears up
    CHECK(folder.entries() == 0);
}

TEST_CASE("Output: what a dead writer has left goes, that of a living one stays") {
    const TemporaryFolder folder;
    const std::string dead = folder.file(".a.exr.0.unfinished"),
                      living = folder.file(".a.exr.1.unfinished"),
                      foreign = folder.file(".b.exr.0.unfinished");
    for (const std::string& file : {dead, living, foreign})
        write_bytes(file, old_content);
    const int writer = ::open(living.c_str(), O_RDWR);
    REQUIRE(::flock(writer, LOCK_EX) == 0);
    write_text_file(folder.file("a.exr"), "new", Existing::keep);
    ::close(writer);
    CHECK_FALSE(fs::exists(dead));
    CHECK(fs::exists(living));
    CHECK(fs::exists(foreign));
    CHECK(read_bytes(folder.file("a.exr")) == new_content);
}

TEST_CASE("Output: two names of one file are refused, however they are spelled") {
    const TemporaryFolder folder;
    const auto refused = [&](const std::string& a, const std::string& b) {
        const std::vector<UsedFile> first{{"--output", a}}, both{{"--output", a}, {"--stats", b}};
        const std::string two = refusal([&] { check_distinct(both, {}); });
        CHECK_THAT(two, Catch::Contains("--output") && Catch::Contains("--stats"));
        const std::string input = refusal([&] { check_distinct(first, {{"the scene", b}}); });
        CHECK_THAT(input, Catch::Contains("--output") && Catch::Contains("the scene"));
    };
    const std::string a = folder.file("a"), b = folder.file("b");
    const std::string here = fs::path(folder.name()).filename().string();
    fs::create_directory_symlink(folder.name(), folder.file("around"));
    const std::vector<std::string> spellings{
        a, folder.file("./a"), folder.file("../" + here + "/a"), folder.file("around/a")};
    for (const bool exists : {false, true}) {
        if (exists) write_bytes(a, old_content);
        for (const std::string& spelling : spellings)
            refused(a, spelling);
        CHECK_NOTHROW(
            check_distinct({{"--output", a}, {"--stats", b}}, {{"the scene", folder.file("c")}}));
    }
    fs::create_symlink("a", folder.file("link"));
    refused(a, folder.file("link"));
    fs::remove(a);
    refused(a, folder.file("link")); // to nothing yet
    write_bytes(a, old_content);
    fs::create_hard_link(a, folder.file("hard"));
    refused(a, folder.file("hard"));
    // Not given is not a file; two inputs may be one.
    CHECK_NOTHROW(
        check_distinct({{"--output", a}, {"--stats", ""}}, {{"", ""}, {"x", b}, {"y", b}}));
}
