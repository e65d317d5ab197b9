// Exit codes are a promise to scripts: their numbers, and what README and --help say of them.
#include "host/commands/exit_codes.h"
#include "host/error.h"

#include <catch2/catch.hpp>

#include <fstream>
#include <sstream>

using namespace parhelion;

TEST_CASE("Exit codes: the numbers that scripts rely on", "[exit codes]") {
    // 99: Grid Engine puts a job that ends with it back into the queue (man sge_conf, section 5).
    const std::array<int, 7> promised{0, 1, 2, 3, 4, 5, 99};
    REQUIRE(exit_code_meanings.size() == promised.size());
    for (std::size_t i = 0; i < promised.size(); i++)
        CHECK(static_cast<int>(exit_code_meanings[i].code) == promised[i]);
    CHECK(static_cast<int>(ExitCode::bad_input) == 2);
    CHECK(static_cast<int>(ExitCode::stopped) == 99);
}

TEST_CASE("Exit codes: README has the table, --help a line for each", "[exit codes]") {
    std::ifstream file(PARHELION_SOURCE_DIR "/README.md");
    std::ostringstream text;
    text << file.rdbuf();
    CHECK_THAT(text.str(),
               Catch::Contains("| exit code | |\n|---|---|\n" + exit_codes_table() + "\n"));
    for (const auto& [code, meaning] : exit_code_meanings)
        CHECK_THAT(exit_codes_text(), Catch::Contains(std::string(meaning)));
}
