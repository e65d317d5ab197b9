// The estimate of a render's time: pieces that lie all over the film, and what is made of what they
// took.
#include "host/render/estimate.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <chrono>
#include <stdexcept>
#include <thread>

using namespace parhelion;

namespace {

constexpr WaveLimits limits{.samples = 16, .band_blocks = 1000, .block_samples = 160};

std::vector<SampleRange> all_of(SpreadPieces pieces, std::size_t at_once) {
    std::vector<SampleRange> all;
    for (;;) {
        const std::vector<SampleRange> some = pieces.next(at_once);
        if (some.empty()) return all;
        all.insert(all.end(), some.begin(), some.end());
    }
}

/// Waves of which each takes so many milliseconds a block and 16 samples, as told by its blocks.
class SlowEngine : public Engine {
public:
    explicit SlowEngine(double (*milliseconds)(int block)) : milliseconds_(milliseconds) {}

    void trace(WaveSchedule& schedule, const std::function<void()>& on_wave) override {
        while (const auto wave = schedule.take()) {
            double sum = 0;
            for (const SampleRange& range : wave->ranges)
                for (int block = range.first_block; block < range.end_block; block++)
                    sum += milliseconds_(block) * (range.end - range.first) / 16;
            std::this_thread::sleep_for(std::chrono::duration<double, std::milli>(sum));
            schedule.finish(*wave);
            on_wave();
        }
    }
    WaveLimits wave_limits() const override { return limits; }
    int blocks_at_once() const override { return 4000; }
    void turn_to(int) override {}
    std::unique_ptr<FilmSums> film() override { throw std::logic_error("there is none"); }
    void fill_film(const FilmSums&) override {}
    TraceCounts counts() override { return {}; }
    std::vector<BadSample> bad_samples() override { return {}; }
    void report(RenderReport&) override {}

private:
    double (*milliseconds_)(int);
};

/// An empty sky over a thicket: four fifths of the film take a hundredth of the time.
double sky(int block) { return block < 3200 ? 0.005 : 2.0; }

RenderEstimate estimate_quietly(Engine& engine, const SampleSet& samples, double seconds) {
    Progress quiet(Progress::Mode::quiet);
    return estimate_render(engine, samples, seconds, quiet);
}

} // namespace

TEST_CASE("Estimate: every sample is in one piece, and no piece is more than a wave",
          "[estimate]") {
    const SampleSet film =
        GENERATE(SampleSet{{0, 4000, 0, 64}}, SampleSet{{0, 4000, 0, 37}}, SampleSet{{0, 3, 0, 5}},
                 SampleSet{{0, 1, 0, 1}}, SampleSet{{0, 4000, 16, 48}},
                 SampleSet{{10, 20, 0, 32}, {500, 1900, 0, 32}}, SampleSet{});
    const std::size_t at_once = GENERATE(std::size_t{1}, std::size_t{7}, std::size_t{100000});
    const std::vector<SampleRange> pieces = all_of({film, limits}, at_once);
    SampleSet sum;
    for (const SampleRange& piece : pieces) {
        CHECK(piece.count() <= limits.block_samples);
        CHECK(piece.end - piece.first <= limits.samples);
        CHECK(piece.first_block / limits.band_blocks == (piece.end_block - 1) / limits.band_blocks);
    }
    CHECK(sample_count(pieces) == sample_count(film));
    if (pieces.size() < 1000 || at_once > 7) // sets are slow to add up
        for (std::size_t i = 0; i < pieces.size(); i += pieces.size() / 200 + 1) {
            CHECK((sum & SampleSet{pieces[i]}).empty());
            CHECK((SampleSet{pieces[i]} - film).empty());
            sum = sum | SampleSet{pieces[i]};
        }
}

TEST_CASE("Estimate: however many pieces are taken, no part of the film is left out",
          "[estimate]") {
    const SampleSet film{{0, 4000, 0, 64}};
    const std::size_t count = GENERATE(5, 10, 33, 100, 399);
    SpreadPieces pieces(film, limits);
    std::vector<int> firsts{0, 4000};
    for (const SampleRange& piece : pieces.next(count))
        firsts.push_back(piece.first_block);
    std::sort(firsts.begin(), firsts.end());
    int gap = 0;
    for (std::size_t i = 1; i < firsts.size(); i++)
        gap = std::max(gap, firsts[i] - firsts[i - 1]);
    CHECK(gap < 3 * 4000 / static_cast<int>(count) + 20);
}

TEST_CASE("Estimate: what waves took, for the rest of them", "[estimate]") {
    SECTION("no wave, no samples") {
        CHECK(estimate_of({}, 100).seconds == 0);
        CHECK(estimate_of({}, 0).seconds == 0);
        CHECK(estimate_of({}, 0).rendered_share == 1);
    }
    SECTION("all of it") {
        const RenderEstimate e = estimate_of({{1.0, 10}, {1.5, 20}}, 20);
        CHECK(e.seconds == 1.5);
        CHECK(e.rendered_share == 1.0);
        CHECK_FALSE(e.uncertainty);
    }
    SECTION("one wave stands for all") {
        const RenderEstimate e = estimate_of({{0.5, 10}}, 100);
        CHECK(e.seconds == 5.0);
        CHECK_FALSE(e.uncertainty);
    }
    SECTION("the cold ones count once, and have no say in the rest") {
        // 3 s for 20 samples, then 1 s for every 10.
        std::vector<WaveTime> waves{{1.0, 10}, {3.0, 20}};
        for (int i = 1; i <= 30; i++)
            waves.push_back({3.0 + i, 20 + 10 * i});
        const RenderEstimate e = estimate_of(waves, 1020);
        CHECK(e.seconds == Approx(3.0 + 100));
        CHECK(e.rendered_seconds == 33.0);
        CHECK(e.rendered_share == Approx(320.0 / 1020));
        REQUIRE(e.uncertainty);
        CHECK(*e.uncertainty == Approx(0).margin(1e-9));
    }
    SECTION("waves that differ: the error of their mean, by Student's t") {
        // 24 waves: of 8 stretches of 3 half take 1 s a wave and half 3 s.
        std::vector<WaveTime> waves{{10.0, 10}, {20.0, 20}};
        for (int i = 0; i < 24; i++)
            waves.push_back(
                {waves.back().seconds + (i / 3 % 2 == 0 ? 1 : 3), waves.back().samples + 10});
        const RenderEstimate e = estimate_of(waves, 10020);
        CHECK(e.seconds == Approx(20.0 + 2 * 1000));
        REQUIRE(e.uncertainty);
        // Standard deviation sqrt(8/7), error of the mean of 8 sqrt(1/7), t of 7 degrees 2.365.
        CHECK(*e.uncertainty == Approx(2.365 * std::sqrt(1.0 / 7) / 2 * 2000 / 2020));
    }
}

TEST_CASE("Estimate: a sky at the top does not mislead", "[estimate]") {
    const SampleSet film{{0, 4000, 0, 64}};
    SlowEngine engine(sky);
    const double truth = 4 * (3200 * 0.005 + 800 * 2.0) / 1000; // 6.5 s
    const RenderEstimate e = estimate_quietly(engine, film, 0.5);
    INFO(e.seconds << " s, rendered " << e.rendered_share << " of it");
    CHECK(e.seconds > truth / 1.5);
    CHECK(e.seconds < truth * 1.5);
    CHECK(e.rendered_share < 0.3);
    CHECK(e.film_share > e.rendered_share);
    REQUIRE(e.uncertainty);
    CHECK(*e.uncertainty > 0.03); // pieces differ by hundreds

    // Of the waves that a render begins with nothing of the thicket is known.
    std::vector<WaveTime> first;
    WaveSchedule schedule(film, limits);
    double seconds = 0;
    std::int64_t done = 0;
    while (seconds < 0.012) {
        const auto wave = schedule.take();
        for (const SampleRange& range : wave->ranges) {
            done += range.count();
            for (int block = range.first_block; block < range.end_block; block++)
                seconds += sky(block) / 1000;
        }
        schedule.finish(*wave);
        first.push_back({seconds, done});
    }
    CHECK(estimate_of(first, sample_count(film)).seconds < truth / 20);
}

TEST_CASE("Estimate: ends in time, whatever waves take", "[estimate]") {
    const SampleSet film{{0, 4000, 0, 64}};
    SECTION("waves longer than all of it") {
        SlowEngine slow([](int) { return 30.0; }); // 300 ms a wave
        const RenderEstimate e = estimate_quietly(slow, film, 0.1);
        CHECK(e.rendered_seconds < 1.0);
        CHECK(e.seconds > 400);
    }
    SECTION("less to do than time for it") {
        SlowEngine fast([](int) { return 0.001; });
        const RenderEstimate e = estimate_quietly(fast, {{0, 100, 0, 16}}, 5);
        CHECK(e.rendered_share == 1.0);
        CHECK(e.film_share == 1.0);
        CHECK(e.seconds == e.rendered_seconds);
    }
    SECTION("nothing to do") {
        SlowEngine none([](int) { return 1.0; });
        CHECK(estimate_quietly(none, {}, 1).seconds == 0);
    }
}
