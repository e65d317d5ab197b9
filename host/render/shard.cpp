// A part of a render, one of several that make the whole between them.
#include "host/render/shard.h"

#include "host/error.h"
#include "host/film/film_parts.h"
#include "host/scene/text.h"
#include "kernels/shared/types.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cstdint>
#include <optional>

namespace parhelion {
namespace {

std::optional<int> whole_number_of(std::string_view text) {
    int value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc() || end != text.data() + text.size() || text.empty())
        return std::nullopt;
    return value;
}

/// Where part `number` of `count`, from 0 on, begins in so many.
int share_begin(int all, int number, int count) {
    return static_cast<int>(static_cast<std::int64_t>(all) * number / count);
}

SampleSet groups_of(const Shard& shard, int blocks, int samples) {
    const int groups = samples / FILM_SAMPLES + (samples % FILM_SAMPLES > 0 ? 1 : 0);
    const auto begin = [&](int number) {
        const std::int64_t sample =
            std::int64_t{FILM_SAMPLES} * share_begin(groups, number, shard.count);
        return static_cast<int>(std::min<std::int64_t>(sample, samples));
    };
    return samples_between(all_samples(blocks, samples), begin(shard.number - 1),
                           begin(shard.number));
}

SampleSet runs_of(const Shard& shard, int blocks, int samples) {
    constexpr int runs = 4; // of each part
    SampleSet all;
    for (int run = 0; run < runs; run++) {
        // In every other run of all parts backwards: what grows from top to bottom is evened out.
        const int place = run % 2 == 0 ? shard.number - 1 : shard.count - shard.number;
        const int from = share_begin(blocks, run * shard.count + place, runs * shard.count);
        const int end = share_begin(blocks, run * shard.count + place + 1, runs * shard.count);
        if (from < end) all = all | SampleSet{{from, end, 0, samples}};
    }
    return all;
}

} // namespace

std::string part_name(const Shard& shard) {
    if (shard.is_all()) return "";
    return fmt::format("{}/{} by {}", shard.number, shard.count,
                       sharding_names[static_cast<std::size_t>(shard.by)]);
}

Shard parse_shard(const std::string& text) {
    const std::size_t slash = text.find('/');
    const auto part = [&](std::size_t from, std::size_t count) {
        return whole_number_of(std::string_view(text).substr(from, count));
    };
    const auto number = part(0, slash);
    const auto count = slash == std::string::npos ? std::nullopt : part(slash + 1, text.size());
    if (!number || !count || *number < 1 || *number > *count || *count > most_shards)
        throw InputError(fmt::format("--shard: found {}; accepted: K/N, part K of N, with K from 1 "
                                     "to N and N up to {}",
                                     in_quotes(text), most_shards));
    return {*number, *count};
}

SampleSet shard_samples(const Shard& shard, int blocks, int samples) {
    if (shard.is_all()) return all_samples(blocks, samples);
    return shard.by == Sharding::samples ? groups_of(shard, blocks, samples)
                                         : runs_of(shard, blocks, samples);
}

} // namespace parhelion
