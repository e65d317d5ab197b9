// A part of a render, one of several that make the whole between them.
#pragma once

#include "host/film/sample_set.h"

#include <array>
#include <string>
#include <string_view>

namespace parhelion {

/// What is shared out: blocks of pixels with all their samples, or groups of samples of all pixels.
#define SHARDINGS(X) X(blocks) X(samples)
#define SHARDING_ENUM(name) name,
enum class Sharding { SHARDINGS(SHARDING_ENUM) };
#define SHARDING_NAME(name) #name,
inline constexpr std::array sharding_names{SHARDINGS(SHARDING_NAME)};

/// Part `number` of `count`, from 1 on.
struct Shard {
    int number = 1, count = 1;
    Sharding by = Sharding::blocks;

    // Of a render that is not shared out.
    bool is_all() const { return count == 1; }
};

/// "K/N by blocks"; of all nothing.
std::string part_name(const Shard& shard);

/// K/N. Throws InputError for a text that is no such part.
Shard parse_shard(const std::string& text);

/// The samples of a part, of so many a pixel. Every sample is in one of the parts, whole groups
/// (FILM_SAMPLES) in the same; of blocks a part has several runs, from places all over the picture,
/// so that parts take about as long. There may be none left for some parts.
SampleSet shard_samples(const Shard& shard, int blocks, int samples);

} // namespace parhelion
