// A render that goes on step by step: what is on its film can be looked at, kept and taken up
// between them.
#pragma once

#include "host/clock.h"
#include "host/film/film_image.h"
#include "host/progress.h"
#include "host/render/engine.h"
#include "host/render/shard.h"

#include <functional>
#include <memory>
#include <optional>

namespace parhelion {

/// Throws InputError where a render of so many samples a pixel cannot go on from a film that has
/// these.
void check_goes_on(const SampleSet& samples, int samples_per_pixel);

class Session {
public:
    /// Of the samples of `shard`. `progress` must outlive it.
    Session(OpenedRender opened, const Shard& shard, Progress& progress);

    /// Puts a film of the same content on this one, which must be empty. Throws as check_goes_on
    /// does, and for samples that are not of this session.
    void take_up(const FilmSums& film, const FilmState& state);

    /// Renders until `stop` says so, which is asked after every wave, or all whole groups of
    /// samples (FILM_SAMPLES) are on the film, or, if they were before, until everything is.
    void step(const std::function<bool()>& stop);

    /// Whether everything is on the film.
    bool finished() const { return left() == 0; }
    /// Whether the film has whole groups of samples alone, so that a render of more samples a pixel
    /// can go on from it.
    bool in_whole_groups() const { return !has_rest_; }

    /// Of the session's samples those that are on the film, 0 to 1.
    double share() const;
    /// Whether all whole groups are on the film.
    bool groups_finished() const { return left_of(groups_) == 0; }

    const FilmContent& content() const { return opened_.content; }
    int blocks() const { return opened_.blocks; }
    /// The samples of the session.
    const SampleSet& all() const { return all_; }
    /// What is on the film.
    FilmState state();
    std::unique_ptr<FilmSums> film() { return opened_.engine->film(); }
    Image image() { return film_image(*film(), opened_.content); }
    /// Closes the stage of progress.
    RenderReport report();

private:
    /// Of blocks whose film is in memory together.
    struct Pass {
        int first_block;
        std::unique_ptr<WaveSchedule> schedule;
    };
    using Passes = std::vector<Pass>;

    void plan();
    Passes passes_of(const SampleSet& todo) const;
    static std::int64_t left_of(const Passes& passes);
    std::int64_t left() const { return left_of(groups_) + left_of(rest_); }

    OpenedRender opened_;
    Progress& progress_;
    SampleSet all_;
    FilmState taken_up_;
    Passes groups_, rest_; ///< one after the other
    std::int64_t todo_ = 0;
    bool has_rest_ = false; ///< samples of a group that is not whole
    std::optional<Clock::time_point> started_;
    double seconds_ = 0; ///< of steps
};

} // namespace parhelion
