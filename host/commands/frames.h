// The renders that one command line asks for: several scenes, sweeps of -D, --frames.
#pragma once

#include "host/commands/name_pattern.h"
#include "host/commands/render.h"

#include <string>
#include <vector>

namespace parhelion {

/// Each scene with each value of each sweep at each frame, the frame changing first.
class Frames {
public:
    /// Throws InputError for frames, sweeps and definitions that are none, a scene that is given
    /// twice, and more renders than most_renders.
    explicit Frames(const RenderCommand& command);

    std::size_t count() const { return count_; }
    bool several() const { return count_ > 1; }

    /// The command of one alone: its scene, its definitions, names of files made from them. Throws
    /// InputError for names with values that there are not.
    RenderCommand command(std::size_t number) const;
    /// That of the only one. Throws InputError, naming `option`, where there are several.
    RenderCommand only(const std::string& option) const;
    /// What makes it another than the others: "hall.xml, angle=20, frame=3".
    std::string title(std::size_t number) const;
    /// All that names of outputs can differ by: "$scene", "$frame"; empty for one render.
    std::vector<std::string> differences() const;

    const std::vector<std::string>& scenes() const { return scenes_.values; }
    /// Renders of a scene, the first of which is that of its number times so many.
    std::size_t of_scene() const { return count_ / scenes_.values.size(); }

private:
    /// Something that has one value or several.
    struct Axis {
        std::string name;
        std::vector<std::string> values;
    };
    using Place = std::vector<std::size_t>; ///< of the scene, then of each axis

    Place place(std::size_t number) const;
    void add_definitions();
    NameValues values_at(const Place& place) const;

    RenderCommand command_;
    Axis scenes_;
    std::vector<Axis> axes_; ///< definitions, and the frame as the last
    std::size_t count_ = 1;
};

} // namespace parhelion
