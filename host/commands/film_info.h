// `parhelion info` of a film in a file: a checkpoint, or a part of a render.
#pragma once

#include "host/film/film_file.h"

#include <nlohmann/json_fwd.hpp>

#include <string>

namespace parhelion {

/// Whether a file is to be taken for a film: it begins as one, whatever it is called, or is called
/// one (.film), which no scene is.
bool is_to_be_film(const std::string& file);

/// One object: picture, part, samples, key, counts; keys that have a unit end in it.
nlohmann::json describe_film(const FilmFile& film);

/// The same for people.
std::string film_text(const nlohmann::json& info);

} // namespace parhelion
