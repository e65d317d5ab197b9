// A render that goes on step by step.
#include "host/render/session.h"

#include "host/error.h"

#include <fmt/format.h>

#include <algorithm>

namespace parhelion {
namespace {

/// Below that number samples come in whole groups.
int whole_samples(int samples_per_pixel) { return samples_per_pixel / FILM_SAMPLES * FILM_SAMPLES; }

} // namespace

// Groups are added up as one: a film that has a part of one cannot get the rest of it.
void check_goes_on(const SampleSet& samples, int samples_per_pixel) {
    for (const SampleRange& range : samples) {
        if (range.end > samples_per_pixel)
            throw InputError(fmt::format("has {} samples a pixel, more than the {} that are asked "
                                         "for (--spp)",
                                         range.end, samples_per_pixel));
        if (range.first % FILM_SAMPLES != 0 ||
            (range.end % FILM_SAMPLES != 0 && range.end != samples_per_pixel))
            throw InputError(fmt::format("ends within a group of {} samples, at sample {}: it "
                                         "cannot be gone on with to {} samples a pixel",
                                         FILM_SAMPLES, range.end, samples_per_pixel));
    }
}

Session::Session(OpenedRender opened, const Shard& shard, Progress& progress)
    : opened_(std::move(opened)), progress_(progress),
      all_(shard_samples(shard, opened_.blocks, opened_.samples_per_pixel)) {
    plan();
}

void Session::plan() {
    const SampleSet todo = all_ - taken_up_.samples;
    const int samples = opened_.samples_per_pixel, whole = whole_samples(samples);
    groups_ = passes_of(samples_between(todo, 0, whole));
    rest_ = passes_of(samples_between(todo, whole, samples));
    todo_ = sample_count(todo);
    has_rest_ = !samples_between(taken_up_.samples, whole, samples).empty();
}

Session::Passes Session::passes_of(const SampleSet& todo) const {
    const Engine& engine = *opened_.engine;
    Passes passes;
    for (int first = 0; first < opened_.blocks; first += engine.blocks_at_once()) {
        const SampleSet some = blocks_between(todo, first, first + engine.blocks_at_once());
        if (!some.empty())
            passes.push_back({first, std::make_unique<WaveSchedule>(some, engine.wave_limits())});
    }
    return passes;
}

std::int64_t Session::left_of(const Passes& passes) {
    std::int64_t left = 0;
    for (const Pass& pass : passes)
        left += pass.schedule->left();
    return left;
}

void Session::take_up(const FilmSums& film, const FilmState& state) {
    check_goes_on(state.samples, opened_.samples_per_pixel);
    if (!(state.samples - all_).empty())
        throw InputError("the film to go on from has samples of another part (--shard)");
    opened_.engine->fill_film(film);
    taken_up_ = state;
    plan();
}

void Session::step(const std::function<bool()>& stop) {
    if (finished()) return;
    if (!started_) {
        progress_.start("rendering", opened_.place);
        started_ = Clock::now();
    }
    const bool in_rest = groups_finished();
    if (in_rest) has_rest_ = true;
    bool stopped = false;
    const auto start = Clock::now();
    for (const Pass& pass : in_rest ? rest_ : groups_) {
        if (stopped || pass.schedule->left() == 0) continue;
        pass.schedule->go_on();
        opened_.engine->turn_to(pass.first_block);
        opened_.engine->trace(*pass.schedule, [&] {
            if (stop()) stopped = true, pass.schedule->stop();
            const auto done = static_cast<double>(todo_ - left());
            progress_.update(done / static_cast<double>(todo_),
                             done * BLOCK_PIXELS / seconds_since(*started_));
        });
    }
    seconds_ += seconds_since(start);
}

double Session::share() const {
    const std::int64_t all = sample_count(all_);
    return all == 0 ? 1.0 : 1.0 - static_cast<double>(left()) / static_cast<double>(all);
}

FilmState Session::state() {
    SampleSet done;
    for (const Passes* passes : {&groups_, &rest_})
        for (const Pass& pass : *passes)
            done = done | pass.schedule->done();
    FilmState state = taken_up_;
    const TraceCounts counts = opened_.engine->counts();
    state.add({done, counts,
               non_finite_samples(counts) > 0 ? opened_.engine->bad_samples()
                                              : std::vector<BadSample>{}});
    return state;
}

RenderReport Session::report() {
    RenderReport report = opened_.report;
    report.render_seconds = seconds_;
    opened_.engine->report(report);
    add_state(state(), report);
    report.taken_up_paths = taken_up_.counts[statistic_camera_rays];
    report.taken_up_rays = report.taken_up_paths + taken_up_.counts[statistic_bounce_rays] +
                           taken_up_.counts[statistic_shadow_rays];
    const auto rate = [&](std::uint64_t count) {
        return seconds_ > 0 ? static_cast<double>(count) / seconds_ / 1e6 : 0.0;
    };
    if (started_)
        progress_.finish(fmt::format("{:.2f} Mpaths/s, {:.2f} Mrays/s",
                                     rate(report.paths - report.taken_up_paths),
                                     rate(report.rays() - report.taken_up_rays)));
    return report;
}

} // namespace parhelion
