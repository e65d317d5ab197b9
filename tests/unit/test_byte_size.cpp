// Amounts of memory on the command line.
#include "host/commands/byte_size.h"
#include "host/error.h"

#include <catch2/catch.hpp>

using namespace parhelion;

TEST_CASE("Amounts of memory are powers of 1024, and nothing else is one", "[command_line]") {
    CHECK(parse_byte_size("--memory", "512M") == 536'870'912);
    CHECK(parse_byte_size("--memory", "2G") == 2'147'483'648);
    CHECK(parse_byte_size("--memory", "1.5G") == 1'610'612'736);
    CHECK(parse_byte_size("--memory", "10K") == 10'240);
    CHECK(parse_byte_size("--memory", "123456789") == 123'456'789);
    CHECK(parse_byte_size("--memory", "1024T") == std::uint64_t{1} << 50);
    for (const char* text : {"", "0", "0G", "-1G", "G", "2GB", "2g", "2 G", "nan", "inf", "1e400G",
                             "1025T", "2G3", "0x10"}) {
        CAPTURE(text);
        CHECK_THROWS_AS(parse_byte_size("--memory", text), InputError);
    }
    CHECK_THROWS_WITH(parse_byte_size("--memory", "much"),
                      "--memory: found \"much\"; accepted: an amount of memory, as 512M, 2G or "
                      "1.5G, up to 1024T");
}
