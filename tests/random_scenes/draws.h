// The numbers of random scenes: ordinary ones, or from all that there are.
#pragma once

#include "host/numerics/measure.h"
#include "tests/random_scenes/random_scene.h"

#include <fmt/format.h>

#include <initializer_list>
#include <string>

namespace parhelion::test {

class Draws {
public:
    Draws(SceneKind kind, std::uint64_t seed)
        : random_(seed), extreme_(kind == SceneKind::extreme) {}

    bool extreme() const { return extreme_; }
    bool chance(double share) { return random_.unit() < share; }
    int below(int count) { return static_cast<int>(random_.unit() * count); }
    double between(double low, double high) { return random_.between(low, high); }

    template<class T>
    T one_of(std::initializer_list<T> list) {
        return *(list.begin() + below(static_cast<int>(list.size())));
    }

    /// Greater than 0: near 1, or of any magnitude that a double of a scene file may have.
    double size() {
        if (!extreme_ || chance(0.6)) return random_.log_between(0.2, 3);
        return chance(0.7) ? random_.log_between(1e-9, 1e9) : random_.log_between(1e-37, 1e37);
    }
    /// A coordinate.
    double place() {
        if (!extreme_ || chance(0.7)) return between(-2, 2);
        return chance(0.2) ? 0.0 : random_.sign() * size();
    }
    /// Not negative; 0 now and then.
    double power() { return extreme_ && chance(0.1) ? 0.0 : 3 * size(); }
    /// 0 to 1, its ends included.
    double share() { return chance(0.1) ? 0.0 : chance(0.1) ? 1.0 : random_.unit(); }
    /// Of a microfacet distribution.
    double roughness() {
        if (!extreme_) return random_.log_between(0.05, 0.8);
        return chance(0.5) ? random_.log_between(1e-5, 2) : size();
    }
    /// Index of refraction.
    double index() {
        if (!extreme_ || chance(0.5)) return between(1.1, 2.2);
        return chance(0.5) ? 1 + random_.sign() * random_.log_between(1e-9, 0.1) : size();
    }
    double angle(double most) {
        if (!extreme_ || chance(0.6)) return between(0.1 * most, 0.9 * most);
        double small = most * random_.log_between(1e-9, 0.1);
        return chance(0.5) ? small : most - small;
    }

private:
    numerics::Random random_;
    bool extreme_;
};

inline std::string number(const char* name, double value) {
    return fmt::format("<float name=\"{}\" value=\"{}\"/>", name, value);
}
inline std::string triple(double x, double y, double z) {
    return fmt::format("{}, {}, {}", x, y, z);
}

} // namespace parhelion::test
