// A film that is kept in a file while it is rendered, for a later render to go on with.
#pragma once

#include "host/clock.h"
#include "host/film/film_file.h"
#include "host/render/session.h"

#include <string>

namespace parhelion {

class Checkpoints {
public:
    /// `header`: of the session but for its state. No file: nothing is kept.
    Checkpoints(std::string file, double seconds, FilmHeader header);

    /// Whether it is time for the next.
    bool due() const;
    /// Keeps what is on the film, unless it is kept already or has parts of groups of samples,
    /// which nothing can go on from: then the one before stays. Where it cannot be written, that
    /// stays too, and a warning says so; rendering goes on.
    void save(Session& session);
    /// Whether the last one could not be written.
    bool failed() const { return failed_; }

private:
    std::string file_;
    double seconds_;
    FilmHeader header_;
    SampleSet kept_;
    Clock::time_point last_ = Clock::now();
    bool failed_ = false;
};

} // namespace parhelion
