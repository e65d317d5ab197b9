// How long a render will take, found by rendering a little of it.
#include "host/render/estimate.h"

#include "host/clock.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numeric>
#include <span>

namespace parhelion {
namespace {

/// Of each range the samples of one number of layer: as many as a wave takes at once, in runs of
/// blocks that fill it; a run lies in one band.
std::vector<SampleRange> pieces_of_layer(const SampleSet& samples, const WaveLimits& limits,
                                         int layer) {
    std::vector<SampleRange> pieces;
    for (const SampleRange& range : samples) {
        const std::int64_t first = range.first + std::int64_t{layer} * limits.samples;
        if (first >= range.end) continue;
        const auto from = static_cast<int>(first);
        const int count = std::min(limits.samples, range.end - from);
        const int most = std::max(1, limits.block_samples / count);
        for (int block = range.first_block, end = 0; block < range.end_block; block = end) {
            const int band_end = (block / limits.band_blocks + 1) * limits.band_blocks;
            end = std::min({block + most, band_end, range.end_block});
            pieces.push_back({block, end, from, from + count});
        }
    }
    return pieces;
}

/// In steps of the golden ratio, each place once.
std::vector<SampleRange> spread(const std::vector<SampleRange>& pieces) {
    const std::size_t count = pieces.size();
    constexpr double golden = 0.6180339887498949;
    auto step =
        std::max<std::size_t>(1, static_cast<std::size_t>(golden * static_cast<double>(count)));
    while (std::gcd(step, count) != 1)
        step++;
    std::vector<SampleRange> order;
    order.reserve(count);
    for (std::size_t i = 0, at = count / 2; i < count; i++, at = (at + step) % count)
        order.push_back(pieces[at]);
    return order;
}

/// Waves in which nothing is as it will be: those of a while, and the first one of each stream.
std::size_t cold_waves(const std::vector<WaveTime>& waves) {
    constexpr double cold_seconds = 0.2;
    constexpr std::size_t least = 2;
    std::size_t count = 0;
    while (count < waves.size() && (count < least || waves[count].seconds < cold_seconds))
        count++;
    // A few are left for the rest to be known from.
    return std::min(count, waves.size() > least ? waves.size() / 2 : waves.size() - 1);
}

/// Of Student's t, two-sided 95 %, by degrees of freedom from 1 on.
constexpr std::array student_t{12.706, 4.303, 3.182, 2.776, 2.571, 2.447, 2.365};

/// How far seconds a sample differ between stretches of equally many waves, behind the first one,
/// as far as that tells of their mean; as a share of it.
std::optional<double> spread_of_costs(std::span<const WaveTime> waves) {
    constexpr std::size_t most = student_t.size() + 1, least = 3, waves_each = 3;
    const std::size_t count = std::min(most, (waves.size() - 1) / waves_each);
    if (count < least) return std::nullopt;
    const std::size_t each = (waves.size() - 1) / count;
    std::vector<double> costs;
    costs.reserve(count);
    for (std::size_t i = 0; i < count; i++) {
        const WaveTime &begin = waves[i * each], &end = waves[(i + 1) * each];
        costs.push_back((end.seconds - begin.seconds) /
                        static_cast<double>(end.samples - begin.samples));
    }
    const auto n = static_cast<double>(count);
    const double mean = std::accumulate(costs.begin(), costs.end(), 0.0) / n;
    double squares = 0;
    for (const double cost : costs)
        squares += (cost - mean) * (cost - mean);
    return student_t[count - 2] * std::sqrt(squares / (n * (n - 1))) / mean;
}

/// Those of blocks whose film is in memory together.
std::vector<SampleSet> by_parts(const std::vector<SampleRange>& pieces, int blocks_at_once) {
    std::map<int, SampleSet> parts;
    for (const SampleRange& piece : pieces)
        parts[piece.first_block / blocks_at_once].push_back(piece);
    std::vector<SampleSet> sets;
    sets.reserve(parts.size());
    for (auto& [number, part] : parts)
        sets.push_back(std::move(part));
    return sets;
}

} // namespace

bool SpreadPieces::next_layer() {
    pieces_ = pieces_of_layer(samples_, limits_, layer_++);
    if (pieces_.empty()) return false;
    pieces_ = spread(pieces_);
    taken_ = 0;
    return true;
}

std::vector<SampleRange> SpreadPieces::next(std::size_t most) {
    std::vector<SampleRange> some;
    some.reserve(most);
    while (some.size() < most && (taken_ < pieces_.size() || next_layer()))
        some.push_back(pieces_[taken_++]);
    return some;
}

RenderEstimate estimate_of(const std::vector<WaveTime>& waves, std::int64_t samples) {
    RenderEstimate estimate;
    if (samples == 0) estimate.rendered_share = 1; // all of nothing
    if (waves.empty() || samples == 0) return estimate;
    const WaveTime& last = waves.back();
    estimate.seconds = estimate.rendered_seconds = last.seconds;
    estimate.rendered_share = static_cast<double>(last.samples) / static_cast<double>(samples);
    if (last.samples == samples) return estimate;
    const std::size_t cold_count = cold_waves(waves);
    // A single wave has to stand for all.
    const WaveTime cold = cold_count == 0 ? WaveTime{} : waves[cold_count - 1];
    const double cost =
        (last.seconds - cold.seconds) / static_cast<double>(last.samples - cold.samples);
    const double warm_seconds = cost * static_cast<double>(samples - cold.samples);
    estimate.seconds = cold.seconds + warm_seconds;
    if (cold_count > 0)
        if (const auto of_costs = spread_of_costs(std::span(waves).subspan(cold_count - 1)))
            estimate.uncertainty = *of_costs * warm_seconds / estimate.seconds;
    return estimate;
}

RenderEstimate estimate_render(Engine& engine, const SampleSet& samples, double seconds,
                               Progress& progress) {
    constexpr std::size_t pieces_at_once = 256; // a schedule looks at all that it has done
    constexpr std::size_t least_waves = 6;
    constexpr double most_times = 5; // as long as asked for, where waves are slow
    std::vector<WaveTime> waves;
    SpreadPieces all(samples, engine.wave_limits());
    std::int64_t before = 0;
    bool enough = false;
    double turned = 0; // seconds: a whole render turns once to each part of the film
    const auto start = Clock::now();
    while (!enough) {
        const std::vector<SampleSet> parts =
            by_parts(all.next(pieces_at_once), engine.blocks_at_once());
        if (parts.empty()) break;
        for (const SampleSet& part : parts) {
            // Of a film that is in memory in parts all of them have had their turn, or none has
            // more say than another.
            const bool may_end = &part == &parts.back();
            const auto turn = Clock::now();
            engine.turn_to(part.front().first_block / engine.blocks_at_once() *
                           engine.blocks_at_once());
            turned += seconds_since(turn);
            const std::int64_t count = sample_count(part);
            WaveSchedule schedule(part, engine.wave_limits());
            engine.trace(schedule, [&] {
                if (enough) return; // of a stream that goes on while another has none any more
                waves.push_back({seconds_since(start) - turned, before + count - schedule.left()});
                const double taken = waves.back().seconds;
                enough = taken >= most_times * seconds ||
                         (may_end && taken >= seconds && waves.size() >= least_waves);
                if (enough) schedule.stop();
                progress.update(std::min(1.0, taken / seconds));
            });
            before += count;
            if (enough) break;
        }
    }
    RenderEstimate estimate = estimate_of(waves, sample_count(samples));
    const std::int64_t first_layer =
        sample_count(pieces_of_layer(samples, engine.wave_limits(), 0));
    if (!waves.empty())
        estimate.film_share = std::min(1.0, static_cast<double>(waves.back().samples) /
                                                static_cast<double>(first_layer));
    return estimate;
}

} // namespace parhelion
