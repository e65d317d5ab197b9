// What a film's file begins with, as JSON.
#pragma once

#include "host/film/film_file.h"

#include <nlohmann/json_fwd.hpp>

namespace parhelion {

nlohmann::json to_json(const FilmHeader& header);
/// Throws nlohmann::json::exception or InputError for what is none.
FilmHeader film_header(const nlohmann::json& json);

} // namespace parhelion
