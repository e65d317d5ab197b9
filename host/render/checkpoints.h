// A film that is kept in a file while it is rendered, for a later render to go on with.
#pragma once

#include "host/clock.h"
#include "host/film/film_file.h"
#include "host/render/session.h"

#include <future>
#include <string>

namespace parhelion {

class Checkpoints {
public:
    /// `header`: of the session but for its state. No file: nothing is kept. `copies`: whether
    /// there is memory for a copy of the film, so that rendering goes on while it is written.
    Checkpoints(std::string file, double seconds, FilmHeader header, bool copies);

    /// Whether it is time for the next.
    bool due() const;
    /// Keeps what is on the film, unless it is kept already or has parts of groups of samples,
    /// which nothing can go on from: then the one before stays. It is written while rendering goes
    /// on; where it cannot be, the one before stays too, and a warning says so.
    void save(Session& session);
    /// Waits for the last one; whether it is there, if any was asked for.
    bool finish();
    /// Whether there is one of this render, once finish() has said so.
    bool any() const { return any_; }

private:
    void write_now(Session& session);

    std::string file_;
    double seconds_;
    FilmHeader header_;
    bool copies_;
    SampleSet kept_; ///< as far as is known
    Clock::time_point last_ = Clock::now();
    std::future<void> writing_;
    bool failed_ = false, any_ = false;
};

} // namespace parhelion
