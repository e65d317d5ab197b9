// How large the buffers of a render are, by what lies in them, and how its work is split.
#include "host/waves/work_sizes.h"

#include <catch2/catch.hpp>

using namespace parhelion;

namespace {

Scene scene_of(int width, int height, FilterKind filter) {
    Scene scene;
    scene.film.width = scene.film.crop_width = width;
    scene.film.height = scene.film.crop_height = height;
    scene.film.filter.kind = filter;
    scene.integrator.second_moment = true;
    scene.integrator.aovs = {{"n", "sh_normal", {}}, {"d", "depth", {}}, {"v", "variance", {}}};
    return scene;
}

WorkSizes sizes_of(const Scene& scene, int samples, int lanes, const WorkSplit& split) {
    return work_sizes(film_layout(scene, plan_aovs(scene)), samples, lanes, split);
}

std::size_t in_blocks(int pixels) { return (static_cast<std::size_t>(pixels) + 3) / 4; }

/// So many arrays that are read side by side: each in lines of its own.
bool holds(std::size_t found, std::size_t arrays, std::size_t elements) {
    return found >= arrays * elements && found % arrays == 0 && found < arrays * (elements + 32);
}

struct Case {
    int width, height, samples, lanes;
    WorkSplit split;
};
const Case cases[] = {{1, 1, 1, 1, {65536, 2048, 1, 1}},
                      {13, 9, 3, 1, {200, 7, 3, 2}},
                      {40, 30, 18, 16, {65536, 2048, 1, 1}},
                      {64, 64, 64, 16, {4096, 100, 8, 2}},
                      {1000, 3, 256, 8, {100000, 333, 1, 3}}};

} // namespace

TEST_CASE("Work sizes: buffers are as long as what lies in them", "[waves]") {
    for (const Case& c : cases) {
        CAPTURE(c.width, c.height, c.samples, c.lanes);
        WorkSizes s =
            sizes_of(scene_of(c.width, c.height, FilterKind::box), c.samples, c.lanes, c.split);
        BufferCounts n = buffer_counts(s);
        std::size_t blocks = in_blocks(c.width) * in_blocks(c.height);
        auto segments = static_cast<std::size_t>(s.segments);
        std::size_t entries = segments * s.segment_stride;
        // A ray is 8 words; paths have throughput, density, index, slot, pixel, sample, where they
        // were scattered and a hit of 3; shadow rays what they bring, their slot, the channel of
        // their light's group and whether they were blocked.
        CHECK(holds(n.path_state, 8 + 11 + 3, entries));
        CHECK(holds(n.shadow_state, 8 + 3 + 1 + 1 + 1, entries));
        // Light, alpha, weight and the two AOVs.
        std::size_t results = 3 + 1 + 1 + 3 + 1;
        CHECK(holds(n.results, results, s.path_capacity));
        CHECK(n.counts == 2 * segments);
        // Rays of three kinds and seven faults, of a segment or a block, of one sample each.
        const auto in_wave = static_cast<std::size_t>(s.path_capacity) / 16;
        CHECK(n.statistics == 10 * std::max(segments, in_wave));
        CHECK(n.wave_blocks == in_wave);
        // Known, sample, x, y, fault and bounce.
        CHECK(n.bad_samples == 6 * blocks);
        // Both parts of the sums of these, of three squares and of seven numbers of how they
        // spread, of every pixel of every block.
        CHECK(holds(n.film, EXACT_WORDS * (results + 3 + 7), blocks * 16));
    }
}

TEST_CASE("Work sizes: light groups are channels of results and film, shapes of results alone",
          "[waves]") {
    for (FilterKind filter : {FilterKind::box, FilterKind::gaussian}) {
        const Scene plain = scene_of(13, 9, filter);
        Scene scene = plain;
        scene.integrator.light_groups = {{"key", {"lamp"}}, {"rest", {}}};
        scene.integrator.cryptomatte.objects = true;
        const WorkSizes without = sizes_of(plain, 3, 1, {200, 7, 3, 2}),
                        with = sizes_of(scene, 3, 1, {200, 7, 3, 2});
        CHECK(with.film.result_channels() == without.film.result_channels() + 2 * 3 + 1);
        CHECK(with.film.channels() == without.film.channels() + 2 * 3);
    }
}

TEST_CASE("Work sizes: a filter that reaches further adds an offset and wider tiles", "[waves]") {
    Scene scene = scene_of(13, 9, FilterKind::gaussian); // reaches 2 pixels
    WorkSizes s = sizes_of(scene, 3, 1, {200, 7, 3, 2});
    BufferCounts n = buffer_counts(s);
    CHECK(holds(n.results, 9 + 2, s.path_capacity));
    CHECK(n.bad_samples == 6 * s.film.window.tiles());
    CHECK(holds(n.film, EXACT_WORDS * (9 + 3 + 7),
                s.film.window.tiles() * (4 + 2 * 2) * (4 + 2 * 2)));
}

TEST_CASE("Work sizes: waves fit the pool, and segments hold them", "[waves]") {
    for (const Case& c : cases) {
        CAPTURE(c.width, c.height, c.samples, c.lanes);
        WorkSizes s =
            sizes_of(scene_of(c.width, c.height, FilterKind::box), c.samples, c.lanes, c.split);
        CHECK(s.path_capacity == s.blocks_per_wave * s.samples_per_wave * 16);
        // A stream's share of the pool, or what is added up together: 16 samples of a block.
        CHECK(s.path_capacity <= std::max(16 * 16, c.split.pool_paths / c.split.streams));
        CHECK((s.samples_per_wave == c.samples || s.samples_per_wave % 16 == 0));
        CHECK(s.segments * s.segment_size >= s.path_capacity);
        CHECK(s.segments % c.split.work_group_size == 0);
        CHECK((s.segments - c.split.work_group_size) * s.segment_size < s.path_capacity);
        // A packed store overwrites a packet behind the last path.
        CHECK(s.segment_stride - s.segment_size == (c.lanes == 1 ? 0 : 16));
        if (c.lanes > 1) CHECK(s.segment_size % 16 == 0);
    }
}

TEST_CASE("Work sizes: a pool that there is no room for is halved down to a group a stream",
          "[waves]") {
    for (const Case& c : cases) {
        CAPTURE(c.width, c.height, c.samples, c.lanes);
        const FilmLayout film =
            film_layout(scene_of(c.width, c.height, FilterKind::box), plan_aovs(Scene{}));
        const std::vector<WorkSizes> choices = pool_choices(film, c.samples, c.lanes, c.split);
        CHECK(choices.front().path_capacity ==
              work_sizes(film, c.samples, c.lanes, c.split).path_capacity);
        for (std::size_t i = 1; i < choices.size(); i++) {
            // The last step may be to what a group leaves.
            CHECK(choices[i].path_capacity < choices[i - 1].path_capacity);
            CHECK(choices[i].path_capacity * 3 >= choices[i - 1].path_capacity);
            CHECK(choices[i].streams == c.split.streams);
        }
        CHECK(choices.back().samples_per_wave == std::min(c.samples, FILM_SAMPLES));
        CHECK(choices.back().path_capacity <= FILM_SAMPLES * BLOCK_PIXELS);
    }
}

TEST_CASE("Work sizes: a wave of any size is spread over all segments, and fits", "[waves]") {
    for (const Case& c : cases) {
        const WorkSizes s =
            sizes_of(scene_of(c.width, c.height, FilterKind::box), c.samples, c.lanes, c.split);
        CAPTURE(c.width, c.height, s.segments, s.segment_size, s.path_capacity);
        for (int paths = 1; paths <= s.path_capacity; paths++) {
            const int size = s.used_segment_size(paths);
            REQUIRE(size <= s.segment_size);
            REQUIRE(std::int64_t{size} * s.segments >= paths);
            REQUIRE((size % (c.lanes == 1 ? 1 : 16) == 0 || size == s.segment_size));
            // No more than a packet in each is left out.
            REQUIRE((size - (c.lanes == 1 ? 1 : 16)) * s.segments < paths);
        }
    }
}
