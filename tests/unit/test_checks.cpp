// When a check of the stress catalogue holds.
#include "host/catalogue/check.h"

#include <catch2/catch.hpp>

#include <cmath>

TEST_CASE("Stress: a check without a number does not hold") {
    parhelion::stress::Check check{.value = NAN, .target = 1};
    CHECK(!check.holds());
    check.at_least = true;
    CHECK(!check.holds());
}
