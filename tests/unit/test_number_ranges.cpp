// Frames and sweeps as texts: every value that they have, and what is none.
#include "host/commands/number_ranges.h"
#include "host/error.h"

#include <catch2/catch.hpp>

#include <cstdlib>

using namespace parhelion;
using Catch::Matchers::Contains;

namespace {

using Frames = std::vector<std::int64_t>;
using Values = std::vector<std::string>;

} // namespace

TEST_CASE("Frames: single ones, ranges, steps, backwards, below 0") {
    const std::vector<std::pair<std::string, Frames>> lists{
        {"7", {7}},
        {"1-4", {1, 2, 3, 4}},
        {"1,3,7-9", {1, 3, 7, 8, 9}},
        {"9,1-2", {9, 1, 2}},
        {"1-10x3", {1, 4, 7, 10}},
        {"1-9x3", {1, 4, 7}},
        {"1-2x5", {1}},
        {"5-5", {5}},
        {"3-1", {3, 2, 1}},
        {"10-1x4", {10, 6, 2}},
        {"-3", {-3}},
        {"-2-1", {-2, -1, 0, 1}},
        {"-5--3", {-5, -4, -3}},
        {"1--1", {1, 0, -1}},
        {"007-009", {7, 8, 9}},
        {"999999999,-999999999", {999'999'999, -999'999'999}},
        {"0-999999999x999999999", {0, 999'999'999}},
    };
    for (const auto& [text, frames] : lists) {
        INFO(text);
        CHECK(parse_frames(text) == frames);
    }
    CHECK(parse_frames("1-100000").size() == most_renders);
}

TEST_CASE("Frames: what is none is refused by name") {
    for (const std::string text :
         {"",       "-",     ",",       "1,",      ",1",         "1,,2",       "1-",
          "1-x2",   "1-2x",  "1-2x0",   "1-2x-1",  "1x2",        "1..3",       "1:3",
          "1-2-3",  "1 - 2", "1, 2",    " 1",      "1.5",        "1e3",        "+1",
          "0x10-2", "a",     "1-2x2x2", "1-2 x 2", "1000000000", "-1000000000"}) {
        INFO(text);
        CHECK_THROWS_WITH(parse_frames(text), Contains("--frames") && Contains("is none"));
    }
    CHECK_THROWS_WITH(parse_frames("1-5,3"), Contains("frame 3 twice"));
    for (const std::string text : {"1-100001", "1-100000,200000", "-999999999-999999999"})
        CHECK_THROWS_WITH(parse_frames(text), Contains("too many"));
    CHECK_THROWS_AS(parse_frames("99999999999999999999"), InputError);
}

TEST_CASE("Sweeps: exact in decimals, ends and directions") {
    const std::vector<std::pair<std::string, Values>> sweeps{
        {"0:10:30", {"0", "10", "20", "30"}},
        {"0:10:35", {"0", "10", "20", "30"}},
        {"0:0.1:1", {"0", "0.1", "0.2", "0.3", "0.4", "0.5", "0.6", "0.7", "0.8", "0.9", "1"}},
        {"90:-30:0", {"90", "60", "30", "0"}},
        {"-1:0.5:1", {"-1", "-0.5", "0", "0.5", "1"}},
        {"-0.25:-0.25:-0.75", {"-0.25", "-0.5", "-0.75"}},
        {"1:0.25:1.8", {"1", "1.25", "1.5", "1.75"}},
        {"5:1:5", {"5"}},
        {"5:-1:5", {"5"}},
        {"1e-3:1e-3:3e-3", {"0.001", "0.002", "0.003"}},
        {"1e2:5E1:2e2", {"100", "150", "200"}},
        {".5:.5:1.", {"0.5", "1"}},
        {"+1:+1:+2", {"1", "2"}},
        {"1.50:0.50:2.50", {"1.5", "2", "2.5"}},
        {"-0:1:1", {"0", "1"}},
        {"0.0001:0.0001:0.0002", {"0.0001", "0.0002"}},
        {"1000000000000000:1:1000000000000001", {"1000000000000000", "1000000000000001"}},
    };
    for (const auto& [text, values] : sweeps) {
        INFO(text);
        CHECK(parse_sweep("-D a", text) == values);
    }
    // No drift: each text is the nearest there is to k / 1000.
    const Values thousandths = parse_sweep("-D a", "0:0.001:10");
    REQUIRE(thousandths.size() == 10001);
    for (std::size_t k = 0; k < thousandths.size(); k++)
        REQUIRE(std::strtod(thousandths[k].c_str(), nullptr) == static_cast<double>(k) / 1000.0);
}

TEST_CASE("Sweeps: other texts are values by themselves, and what has no value is refused") {
    for (const std::string text :
         {"", "1", "1:2", "1:2:3:4", "a:b:c", "0:ten:90", "::", "0::1", "0:1:", ":1:2", "0 : 1 : 2",
          "nan:1:2", "0:inf:1", "0.5, 0.2, 1", "12:30:pm", "0x1:0x1:0x2"}) {
        INFO(text);
        CHECK(parse_sweep("-D a", text).empty());
    }
    for (const std::string text : {"0:0:1", "0:0:0", "0:-1:1", "1:1:0", "1:0.1:0.9"}) {
        INFO(text);
        CHECK_THROWS_WITH(parse_sweep("-D a", text), Contains("-D a=" + text + ": has no value"));
    }
    for (const std::string text : {"1:1:1e9", "0:1e-6:1", "0:1:100000"})
        CHECK_THROWS_WITH(parse_sweep("-D a", text), Contains("too many"));
    CHECK(parse_sweep("-D a", "1:1:100000").size() == most_renders);
    for (const std::string text :
         {"0:1e-300:1e300", "1e17:1:1e17", "0:1:1e300", "1e-20:1:2", "0.12345678901234567890:1:2"})
        CHECK_THROWS_WITH(parse_sweep("-D a", text), Contains("too many digits"));
}
