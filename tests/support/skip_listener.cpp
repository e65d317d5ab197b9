// What was skipped is told once more at the end of a run without failures: the line that ctest
// looks for. A failure is never taken for something skipped.
#define CATCH_CONFIG_EXTERNAL_INTERFACES
#include <catch2/catch.hpp>

#include "tests/support/skip.h"

#include <iostream>
#include <vector>

namespace parhelion::test {
namespace {

/// Of this process.
std::vector<std::string>& reasons() {
    static std::vector<std::string> list;
    return list;
}

struct SkipListener : Catch::TestEventListenerBase {
    using TestEventListenerBase::TestEventListenerBase;

    void testRunEnded(const Catch::TestRunStats& stats) override {
        if (!stats.totals.testCases.allOk()) return;
        for (const std::string& reason : reasons())
            std::cout << "skipped, not passed: " << reason << "\n";
    }
};
CATCH_REGISTER_LISTENER(SkipListener)

} // namespace

void skip(const std::string& reason) { reasons().push_back(reason); }

} // namespace parhelion::test
