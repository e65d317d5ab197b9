// Samples that were not finite and are left out of the image: where they are and what went wrong.
#include "host/film/bad_samples.h"

#include <algorithm>
#include <optional>
#include <tuple>

namespace parhelion {
namespace {

constexpr std::size_t most = 16;

std::optional<BadSample> read(const int* fields) {
    if (!fields[bad_sample_known]) return std::nullopt;
    return BadSample{fields[bad_sample_x], fields[bad_sample_y], fields[bad_sample_sample],
                     fields[bad_sample_fault], fields[bad_sample_bounce]};
}

bool before(const BadSample& a, const BadSample& b) {
    return std::tie(a.sample, a.y, a.x) < std::tie(b.sample, b.y, b.x);
}

} // namespace

std::vector<BadSample> first_bad_samples(const std::vector<std::vector<int>>& of_streams) {
    std::vector<BadSample> found;
    std::size_t words = of_streams.empty() ? 0 : of_streams[0].size();
    for (std::size_t block = 0; block < words; block += bad_sample_field_count) {
        std::optional<BadSample> first;
        for (const std::vector<int>& stream : of_streams) {
            std::optional<BadSample> bad = read(&stream[block]);
            if (bad && (!first || before(*bad, *first))) first = bad;
        }
        if (first) found.push_back(*first);
    }
    return first_of(std::move(found));
}

std::vector<BadSample> first_of(std::vector<BadSample> all) {
    std::sort(all.begin(), all.end(), before);
    const auto same = [](const BadSample& a, const BadSample& b) {
        return !before(a, b) && !before(b, a);
    };
    all.erase(std::unique(all.begin(), all.end(), same), all.end());
    if (all.size() > most) all.resize(most);
    return all;
}

} // namespace parhelion
