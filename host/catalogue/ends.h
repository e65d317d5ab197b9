// Sets of three random numbers that sampling routines stumble over.
#pragma once

#include "host/numerics/measure.h"

#include <cstdint>

namespace parhelion::stress {

/// All corners of the cube of three random numbers, then random ones, with an end now and then.
class Ends {
public:
    explicit Ends(std::uint64_t seed) : random_(seed) {}

    /// Set `i`, of any number of them.
    f32::vec3 numbers(std::uint64_t i) {
        auto number = [&](int k) {
            if (i < 8) return i >> k & 1 ? last : 0.f;
            return random_.bits() % 4   ? static_cast<float>(random_.unit())
                   : random_.bits() % 2 ? last
                                        : 0.f;
        };
        float x = number(0), y = number(1);
        return {x, y, number(2)};
    }
    numerics::Random& random() { return random_; }

private:
    static constexpr float last = 1 - 0x1p-24f;
    numerics::Random random_;
};

} // namespace parhelion::stress
