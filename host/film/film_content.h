// What the sums of a film are of, and what picture is made of them: all that is asked of a scene
// once its samples are on the film.
#pragma once

#include "host/film/cryptomatte.h"
#include "host/film/film_layout.h"
#include "host/flatten/scene_frame.h"

#include <nlohmann/json_fwd.hpp>

namespace parhelion {

struct FilmContent {
    Film film; ///< its crop resolved
    IntegratorKind kind = IntegratorKind::path;
    bool second_moment = false;
    AovPlan aovs;
    SceneFrame frame;
    Cryptomatte cryptomatte{};

    int channels() const {
        return FILM_CHANNELS(aovs.channels, second_moment, !aovs.film_layers.empty());
    }
    int square_channel() const { return SQUARE_CHANNEL(aovs.channels); }
    int spread_channel() const { return SPREAD_CHANNEL(aovs.channels, second_moment); }
};

FilmContent film_content(const Scene& scene, const AovPlan& aovs, const SceneFrame& frame);

nlohmann::json to_json(const FilmContent& content);
/// Throws nlohmann::json::exception or InputError for what is none.
FilmContent film_content(const nlohmann::json& json);

} // namespace parhelion
