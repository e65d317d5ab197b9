// Few groups of things in which every two of them are together somewhere.
#pragma once

#include <cstddef>
#include <functional>
#include <vector>

namespace parhelion::test {

using Group = std::vector<std::size_t>;

/// Groups of up to `size` of the things 0 to count - 1, none with two that exclude each other, and
/// every two that do not are in one of them. Each begins with two that had not met and takes, one
/// at a time, what meets the most that it had not (a greedy covering design).
inline std::vector<Group>
groups_of_every_two(std::size_t count, std::size_t size,
                    const std::function<bool(std::size_t, std::size_t)>& exclude) {
    std::vector<std::vector<bool>> open(count, std::vector<bool>(count));
    for (std::size_t a = 0; a < count; a++)
        for (std::size_t b = 0; b < count; b++)
            open[a][b] = a != b && !exclude(a, b);
    auto gain = [&](const Group& group, std::size_t c) {
        int met = 0;
        for (std::size_t member : group) {
            if (member == c || exclude(member, c)) return -1;
            met += open[member][c];
        }
        return met;
    };
    std::vector<Group> groups;
    for (std::size_t a = 0; a < count; a++)
        for (std::size_t b = a + 1; b < count; b++) {
            if (!open[a][b]) continue;
            Group group{a, b};
            while (group.size() < size) {
                std::size_t best = count;
                int most = 0; // what meets nothing new stays out
                for (std::size_t c = 0; c < count; c++)
                    if (int met = gain(group, c); met > most) best = c, most = met;
                if (best == count) break;
                group.push_back(best);
            }
            for (std::size_t x : group)
                for (std::size_t y : group)
                    open[x][y] = false;
            groups.push_back(group);
        }
    return groups;
}

} // namespace parhelion::test
