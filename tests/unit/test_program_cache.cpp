// Programs are kept and read by several threads at a time.
#include "host/cl/program_cache.h"
#include "host/parallel.h"

#include <catch2/catch.hpp>
#include <fmt/format.h>
#include <unistd.h>

using namespace parhelion;

TEST_CASE("Program cache: threads that store, load and miss beside each other") {
    auto folder =
        std::filesystem::temp_directory_path() / fmt::format("parhelion-threads-{}", getpid());
    ProgramCache cache(folder);
    constexpr std::size_t count = 64;
    auto key = [](std::size_t i) { return fmt::format("program {}", i); };
    auto binary = [](std::size_t i) { return std::vector<unsigned char>(100 + i, i); };
    parallel_for(count, [&](std::size_t i) { cache.store(key(i), binary(i)); });
    std::vector<int> found(count + 1);
    parallel_for(found.size(), [&](std::size_t i) {
        auto loaded = cache.load(key(i)).binary;
        found[i] = loaded && *loaded == binary(i);
    });
    std::vector<int> stored(count, 1);
    stored.push_back(0);
    CHECK(found == stored);
    std::filesystem::remove_all(folder);
}
