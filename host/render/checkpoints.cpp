// A film that is kept in a file while it is rendered, for a later render to go on with.
#include "host/render/checkpoints.h"

#include "host/error.h"
#include "host/streams.h"

#include <fmt/format.h>

namespace parhelion {

Checkpoints::Checkpoints(std::string file, double seconds, FilmHeader header, bool copies)
    : file_(std::move(file)), seconds_(seconds), header_(std::move(header)), copies_(copies) {}

bool Checkpoints::due() const { return !file_.empty() && seconds_since(last_) >= seconds_; }

bool Checkpoints::finish() {
    if (!writing_.valid()) return !failed_;
    try {
        writing_.get();
        failed_ = false, any_ = true;
    } catch (const OutputError& e) {
        failed_ = true;
        kept_.clear();
        say(fmt::format("warning: no checkpoint could be written: {}; rendering goes on",
                        e.what()));
    }
    return !failed_;
}

void Checkpoints::save(Session& session) {
    if (file_.empty() || !session.in_whole_groups()) return;
    finish();
    header_.state = session.state();
    last_ = Clock::now();
    if (header_.state.samples.empty() || header_.state.samples == kept_) return;
    if (!copies_) return write_now(session);
    // Waiting for a disk takes longer than copying what there is.
    std::string bytes = film_bytes(header_, *session.film());
    kept_ = header_.state.samples;
    writing_ = std::async(std::launch::async, [file = file_, bytes = std::move(bytes)] {
        write_text_file(file, bytes, Existing::replace);
    });
}

void Checkpoints::write_now(Session& session) {
    const auto film = session.film();
    kept_ = header_.state.samples;
    writing_ = std::async(std::launch::deferred,
                          [&] { write_film(file_, header_, *film, Existing::replace); });
    finish();
}

} // namespace parhelion
