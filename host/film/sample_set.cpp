// Which samples of which blocks: of a film those that are on it, of a render those that are left.
#include "host/film/sample_set.h"

#include <algorithm>
#include <limits>

namespace parhelion {
namespace {

/// Of a block, ascending.
using Numbers = std::vector<int>;

/// Where ranges begin and end.
Numbers ends(const SampleSet& a, const SampleSet& b, int SampleRange::*first,
             int SampleRange::*end) {
    Numbers all;
    for (const SampleSet* set : {&a, &b})
        for (const SampleRange& range : *set)
            all.push_back(range.*first), all.push_back(range.*end);
    std::sort(all.begin(), all.end());
    all.erase(std::unique(all.begin(), all.end()), all.end());
    return all;
}

/// The ranges that have a block, of a set.
SampleSet of_block(const SampleSet& set, int block) {
    SampleSet found;
    for (const SampleRange& range : set)
        if (range.first_block <= block && block < range.end_block) found.push_back(range);
    return found;
}

bool has(const SampleSet& of_one_block, int sample) {
    return std::any_of(of_one_block.begin(), of_one_block.end(), [&](const SampleRange& range) {
        return range.first <= sample && sample < range.end;
    });
}

/// Samples of one block that `keep(in a, in b)` keeps.
template<class Keep>
SampleSet combined_block(const SampleSet& a, const SampleSet& b, int first_block, int end_block,
                         Keep keep) {
    SampleSet result;
    const Numbers at = ends(a, b, &SampleRange::first, &SampleRange::end);
    for (std::size_t i = 0; i + 1 < at.size(); i++) {
        if (!keep(has(a, at[i]), has(b, at[i]))) continue;
        if (!result.empty() && result.back().end == at[i])
            result.back().end = at[i + 1];
        else
            result.push_back({first_block, end_block, at[i], at[i + 1]});
    }
    return result;
}

/// Whether `next` says the same of the blocks that follow those of `last`.
bool goes_on(const SampleSet& last, const SampleSet& next) {
    return std::equal(last.begin(), last.end(), next.begin(), next.end(),
                      [](const SampleRange& a, const SampleRange& b) {
                          return a.end_block == b.first_block && a.first == b.first &&
                                 a.end == b.end;
                      });
}

template<class Keep>
SampleSet combined(const SampleSet& a, const SampleSet& b, Keep keep) {
    SampleSet result, last;
    const Numbers at = ends(a, b, &SampleRange::first_block, &SampleRange::end_block);
    for (std::size_t i = 0; i + 1 < at.size(); i++) {
        const SampleSet next =
            combined_block(of_block(a, at[i]), of_block(b, at[i]), at[i], at[i + 1], keep);
        if (goes_on(last, next)) {
            for (SampleRange& range : last)
                range.end_block = at[i + 1];
            continue;
        }
        result.insert(result.end(), last.begin(), last.end());
        last = next;
    }
    result.insert(result.end(), last.begin(), last.end());
    return result;
}

} // namespace

std::int64_t sample_count(const SampleSet& set) {
    std::int64_t count = 0;
    for (const SampleRange& range : set)
        count += range.count();
    return count;
}

SampleSet all_samples(int blocks, int samples) {
    if (blocks == 0 || samples == 0) return {};
    return {{0, blocks, 0, samples}};
}

SampleSet operator|(const SampleSet& a, const SampleSet& b) {
    return combined(a, b, [](bool in_a, bool in_b) { return in_a || in_b; });
}

SampleSet operator&(const SampleSet& a, const SampleSet& b) {
    return combined(a, b, [](bool in_a, bool in_b) { return in_a && in_b; });
}

SampleSet operator-(const SampleSet& a, const SampleSet& b) {
    return combined(a, b, [](bool in_a, bool in_b) { return in_a && !in_b; });
}

int fewest_samples(const SampleSet& set, int blocks) {
    const SampleSet whole{{0, blocks, 0, 1}};
    const Numbers at = ends(set, whole, &SampleRange::first_block, &SampleRange::end_block);
    int fewest = std::numeric_limits<int>::max();
    for (std::size_t i = 0; i + 1 < at.size(); i++) {
        int samples = 0;
        for (const SampleRange& range : of_block(set, at[i]))
            samples += range.end - range.first;
        fewest = std::min(fewest, samples);
    }
    return fewest;
}

SampleSet samples_between(const SampleSet& set, int first, int end) {
    if (first >= end) return {};
    return set & SampleSet{{0, std::numeric_limits<int>::max(), first, end}};
}

SampleSet blocks_between(const SampleSet& set, int first, int end) {
    if (first >= end) return {};
    return set & SampleSet{{first, end, 0, std::numeric_limits<int>::max()}};
}

} // namespace parhelion
