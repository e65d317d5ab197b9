// Work shared out among threads: all of it is done, once.
#include "host/parallel.h"

#include <catch2/catch.hpp>

#include <vector>

using namespace parhelion;

TEST_CASE("Parallel: every number once, none of no numbers") {
    for (std::size_t count : {0, 1, 3, 4, 5, 1000, 100003}) {
        CAPTURE(count);
        std::vector<int> visits(count);
        parallel_for(count, [&](std::size_t i) { visits[i]++; });
        CHECK(visits == std::vector<int>(count, 1));
    }
}

TEST_CASE("Parallel: a sum of all numbers, from nothing on") {
    auto add = [](std::size_t sum, std::size_t i) { return sum + i; };
    auto join = [](std::size_t a, std::size_t b) { return a + b; };
    for (std::size_t count : {0, 1, 3, 4, 5, 1000, 100003}) {
        CAPTURE(count);
        std::size_t none = 0;
        CHECK(parallel_sum(count, none, add, join) == (count ? count * (count - 1) / 2 : 0));
    }
}

TEST_CASE("Parallel: a group waits for its tasks, those of tasks too") {
    int left = 0, right = 0, deep = 0;
    TaskGroup group;
    group.run([&] {
        TaskGroup inner;
        inner.run([&] { deep = 3; });
        left = 1;
        inner.wait();
        left += deep;
    });
    group.run([&] { right = 2; });
    group.wait();
    CHECK(left == 4);
    CHECK(right == 2);
}
