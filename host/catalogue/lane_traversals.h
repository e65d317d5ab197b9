// The kernels that trace rays for 16, 8 and 1 lanes and as C++, packets and streams: all give the
// same bits.
#pragma once

#include "host/catalogue/ray_rows.h"

#include <fmt/format.h>

#include <functional>
#include <memory>
#include <stdexcept>

namespace parhelion::stress {

/// Rays by themselves, and bundles of 16 from one point that spread by 1e-1 to 1e-6, 16 each in
/// turn: what packets of a camera's rays are.
class Bundles {
public:
    using Make = std::function<TracedRay(std::uint64_t)>;
    explicit Bundles(Make make) : make_(std::move(make)) {}

    TracedRay ray(rays::Random& random, std::uint64_t i) {
        if (i / 16 % 2 == 0) return make_(i);
        if (i % 16 == 0) {
            first_ = make_(i / 16);
            spread_ = std::pow(10.f, rays::uniform(random, -6, -1));
            largest_ = 0;
            for (float d : first_.direction)
                largest_ = std::max(largest_, std::fabs(d));
        }
        TracedRay ray = first_;
        if (i % 16 != 0)
            ray.direction =
                rays::add(ray.direction,
                          rays::uniform_vector(random, -spread_ * largest_, spread_ * largest_));
        return ray;
    }

private:
    Make make_;
    TracedRay first_{};
    float spread_ = 0, largest_ = 0;
};

class LaneTraversals {
    struct Other {
        int lanes;
        std::unique_ptr<Traversal> traversal;
        std::uint64_t rays = 0, differing = 0;
    };

    Traversal& own_;
    std::size_t share_;
    std::vector<Other> others_;

    template<class Ask>
    auto ask(std::span<const TracedRay> rays, const Ask& question) {
        auto found = question(own_, rays);
        auto some = rays.first((rays.size() + share_ - 1) / share_);
        for (Other& o : others_) {
            auto answers = question(*o.traversal, some);
            for (std::size_t i = 0; i < answers.size(); i++)
                o.differing += answers[i] != found[i];
            o.rays += answers.size();
        }
        return found;
    }

public:
    /// Answers come from the run's own kernels; of the rays of every call the first
    /// of so many parts goes through the others.
    explicit LaneTraversals(StressRun& run) : own_(run.traversal()), share_(run.count(1, 1, 16)) {
        for (int lanes : {1, 8, 16})
            if (lanes != run.kernels.lanes)
                others_.push_back({lanes, std::make_unique<Traversal>(
                                              run.device, ProgramOptions{.lanes = lanes})});
    }

    void upload(std::span<const PrimitiveRecord> primitives) {
        own_.upload(primitives);
        for (Other& o : others_)
            o.traversal->upload(primitives);
    }

    std::vector<TracedHit> closest(std::span<const TracedRay> rays) {
        return ask(rays, [](Traversal& t, auto some) { return t.closest(some); });
    }
    std::vector<bool> occluded(std::span<const TracedRay> rays) {
        return ask(rays, [](Traversal& t, auto some) { return t.occluded(some); });
    }

    Checks checks(const std::string& row) {
        Checks list;
        for (const Other& o : others_)
            list.push_back(rays_check(fmt::format("{}: other bits with {} lanes", row, o.lanes),
                                      o.differing, o.rays));
        list.push_back(host_check(row, own_));
        return list;
    }
};

} // namespace parhelion::stress
