// Films that are to be added up: parts of one render, each sample in one of them.
#pragma once

#include "host/film/film_file.h"

#include <deque>
#include <string>
#include <vector>

namespace parhelion {

/// As many as a render is shared out to.
inline constexpr int most_shards = 65536;

/// Throws InputError, in one line, where two are not of one render or share samples, naming them.
/// At least one.
void check_parts(const std::deque<FilmFile>& parts);

/// Of what they add up to. They have passed check_parts.
FilmHeader added_header(const std::deque<FilmFile>& parts);

/// What is not there of the whole render: parts by their names where that is known, and the
/// samples; nothing where all is there.
std::string missing_text(const std::deque<FilmFile>& parts, const FilmHeader& added);

} // namespace parhelion
