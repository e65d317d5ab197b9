// The stress catalogue in small: every row of the list, and every check holds.
#include "host/catalogue/catalogue.h"
#include "host/catalogue/report.h"
#include "tests/support/device.h"

using namespace parhelion;

TEST_CASE("Stress: every check of the catalogue holds", "[device]") {
    test::TestDevice d;
    Progress quiet(Progress::Mode::quiet);
    stress::StressRun run(d, stress::Effort::test, 1, quiet);
    for (const stress::Row& row : stress::catalogue()) {
        CAPTURE(row.name);
        stress::Checks checks = row.run(run);
        CHECK(!checks.empty());
        for (const stress::Check& check : checks) {
            INFO(stress::text_line(check));
            CHECK(check.holds());
        }
    }
}

TEST_CASE("Stress: a check without a number does not hold", "[device]") {
    stress::Check check{.value = NAN, .target = 1};
    CHECK(!check.holds());
    check.at_least = true;
    CHECK(!check.holds());
}
