// Work for several threads, through oneTBB.
//
// ThreadSanitizer does not see into that library and takes its order for none. In a build for it
// the same work goes to plain threads: who shares it out makes no difference to races in the work.
#pragma once

#ifndef PARHELION_PLAIN_THREADS
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/parallel_reduce.h>
#include <tbb/task_group.h>

#include <cstddef>

namespace parhelion {

using TaskGroup = tbb::task_group;

/// body(i) for i in [0, count), in no order.
template<class Body>
void parallel_for(std::size_t count, const Body& body) {
    tbb::parallel_for(std::size_t{0}, count, body);
}

/// Of add(sum, i) for i in [0, count) from `none` on, partial sums joined by join(a, b); in an
/// order that differs between runs, so that rounding must not depend on it.
template<class Sum, class Add, class Join>
Sum parallel_sum(std::size_t count, const Sum& none, const Add& add, const Join& join) {
    using Range = tbb::blocked_range<std::size_t>;
    auto add_range = [&](const Range& range, Sum sum) {
        for (std::size_t i = range.begin(); i < range.end(); i++)
            sum = add(sum, i);
        return sum;
    };
    return tbb::parallel_reduce(Range(0, count), none, add_range, join);
}

} // namespace parhelion

#else
#include <algorithm>
#include <array>
#include <cstddef>
#include <thread>
#include <utility>
#include <vector>

namespace parhelion {

class TaskGroup {
public:
    template<class Task>
    void run(Task task) {
        threads_.emplace_back(std::move(task));
    }
    void wait() { threads_.clear(); } // a jthread joins

private:
    std::vector<std::jthread> threads_;
};

inline constexpr std::size_t parallel_parts = 4;

/// body(part, first, end) for each part of [0, count), each in a thread.
template<class Body>
void parallel_ranges(std::size_t count, const Body& body) {
    TaskGroup threads;
    std::size_t size = count / parallel_parts + 1;
    for (std::size_t part = 0; part * size < count; part++)
        threads.run([&body, part, first = part * size, end = std::min(count, (part + 1) * size)] {
            body(part, first, end);
        });
    threads.wait();
}

template<class Body>
void parallel_for(std::size_t count, const Body& body) {
    parallel_ranges(count, [&](std::size_t, std::size_t first, std::size_t end) {
        for (std::size_t i = first; i < end; i++)
            body(i);
    });
}

template<class Sum, class Add, class Join>
Sum parallel_sum(std::size_t count, const Sum& none, const Add& add, const Join& join) {
    std::array<Sum, parallel_parts> sums;
    sums.fill(none);
    parallel_ranges(count, [&](std::size_t part, std::size_t first, std::size_t end) {
        for (std::size_t i = first; i < end; i++)
            sums[part] = add(sums[part], i);
    });
    Sum all = none;
    for (const Sum& sum : sums)
        all = join(all, sum);
    return all;
}

} // namespace parhelion
#endif
