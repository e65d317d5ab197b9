// The page on accuracy tells of everything that is asked.
#include "host/catalogue/catalogue.h"

#include <catch2/catch.hpp>

#include <fstream>
#include <iterator>
#include <string>

TEST_CASE("docs/accuracy.md names every row of the stress catalogue") {
    std::ifstream file(PARHELION_SOURCE_DIR "/docs/accuracy.md");
    std::string page{std::istreambuf_iterator<char>(file), {}};
    for (const parhelion::stress::Row& row : parhelion::stress::catalogue()) {
        INFO(row.name);
        CHECK(page.find(row.name) != std::string::npos);
    }
}
