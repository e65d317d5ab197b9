// Sets of samples of blocks, against sets of pairs.
#include "host/film/sample_set.h"
#include "host/numerics/measure.h"
#include "host/render/shard.h"
#include "kernels/shared/types.h"

#include <catch2/catch.hpp>

#include <limits>
#include <set>

using namespace parhelion;
using numerics::Random;

namespace {

using Pairs = std::set<std::pair<int, int>>; // block, sample

Pairs pairs_of(const SampleSet& set) {
    Pairs pairs;
    for (const SampleRange& range : set)
        for (int block = range.first_block; block < range.end_block; block++)
            for (int sample = range.first; sample < range.end; sample++)
                pairs.emplace(block, sample);
    return pairs;
}

template<class Keep>
Pairs pairs_where(Keep keep) {
    Pairs pairs;
    for (int block = 0; block < 12; block++)
        for (int sample = 0; sample < 12; sample++)
            if (keep(std::pair{block, sample})) pairs.emplace(block, sample);
    return pairs;
}

} // namespace

TEST_CASE("Sample sets: union, intersection and difference are those of their samples") {
    Random random(11);
    auto below = [&](int n) { return static_cast<int>(random.bits() % static_cast<unsigned>(n)); };
    for (int round = 0; round < 300; round++) {
        SampleSet a, b;
        for (SampleSet* set : {&a, &b})
            for (int k = below(5); k > 0; k--) {
                const int block = below(11), sample = below(11);
                const SampleSet more{{block, block + 1 + below(11 - block), sample,
                                      sample + 1 + below(11 - sample)}};
                *set = *set | more;
            }
        const Pairs in_a = pairs_of(a), in_b = pairs_of(b);
        CHECK(static_cast<std::size_t>(sample_count(a)) == in_a.size()); // disjoint
        CHECK(pairs_of(a | b) ==
              pairs_where([&](auto p) { return in_a.count(p) > 0 || in_b.count(p) > 0; }));
        CHECK(pairs_of(a & b) ==
              pairs_where([&](auto p) { return in_a.count(p) > 0 && in_b.count(p) > 0; }));
        CHECK(pairs_of(a - b) ==
              pairs_where([&](auto p) { return in_a.count(p) > 0 && in_b.count(p) == 0; }));
        CHECK(((a - b) | (a & b)) == a); // one form, however it came about
        CHECK((a | b) == (b | (a - b)));
        const int from = below(12), to = below(12);
        CHECK(pairs_of(samples_between(a, from, to)) == pairs_where([&](auto p) {
                  return in_a.count(p) > 0 && p.second >= from && p.second < to;
              }));
    }
}

TEST_CASE("Shards: every sample is in one, whole groups in the same, and shares are even") {
    for (const Sharding by : {Sharding::blocks, Sharding::samples})
        for (const int count : {1, 2, 3, 7, 16, 40})
            for (const auto& [blocks, samples] :
                 {std::pair{1, 1}, {256, 1024}, {97, 100}, {5, 33}}) {
                SampleSet all;
                std::int64_t most = 0, sum = 0;
                for (int number = 1; number <= count; number++) {
                    const SampleSet part = shard_samples({number, count, by}, blocks, samples);
                    for (const SampleRange& range : part)
                        CHECK((range.first % FILM_SAMPLES == 0 &&
                               (range.end % FILM_SAMPLES == 0 || range.end == samples)));
                    CHECK((all & part).empty());
                    all = all | part;
                    most = std::max(most, sample_count(part)), sum += sample_count(part);
                }
                CHECK(all == all_samples(blocks, samples));
                CHECK(sum == std::int64_t{blocks} * samples);
                // Within a group of all blocks, or four blocks.
                const std::int64_t grain = by == Sharding::samples ? 16LL * blocks : 4LL * samples;
                CHECK(most <= sum / count + grain);
            }
}

TEST_CASE("Shards: what is no part of anything is refused") {
    for (const char* text : {"", "1", "0/2", "3/2", "1/0", "-1/2", "1/2/3", "a/b", "1/ 2",
                             "1/70000", "99999999999/99999999999", "1.5/2"})
        CHECK_THROWS_WITH(parse_shard(text), Catch::StartsWith("--shard: found"));
    CHECK(parse_shard("7/16").number == 7);
    CHECK(parse_shard("7/16").count == 16);
}

TEST_CASE("Shards: of as many samples as there can be, the last parts have the last of them") {
    const int most = std::numeric_limits<int>::max(), blocks = 4096 * 4096;
    for (const int count : {2, 65536}) {
        std::int64_t sum = 0;
        int end = 0;
        for (int number = 1; number <= count; number++) {
            const SampleSet part = shard_samples({number, count, Sharding::samples}, blocks, most);
            REQUIRE(part.size() == 1);
            REQUIRE(part[0].first == end);
            REQUIRE(part[0].end > end);
            end = part[0].end, sum += sample_count(part);
        }
        CHECK(end == most);
        CHECK(sum == std::int64_t{blocks} * most);
        CHECK(sum == sample_count(all_samples(blocks, most)));
    }
}
