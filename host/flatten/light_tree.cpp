// The light tree: lights grouped by place, orientation and strength.
#include "host/flatten/light_tree.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <numeric>
#include <optional>
#include <tuple>

namespace parhelion {
namespace {

constexpr double pi = std::numbers::pi;

double angle_of(double cosine) { return std::acos(std::clamp(cosine, -1.0, 1.0)); }

/// v turned about the unit vector k (Rodrigues).
glm::dvec3 turned(const glm::dvec3& v, const glm::dvec3& k, double angle) {
    double c = std::cos(angle), s = std::sin(angle);
    return v * c + glm::cross(k, v) * s + k * glm::dot(k, v) * (1.0 - c);
}

/// Axis and cosine of the spread of the smallest cone around two.
std::pair<glm::dvec3, double> merged_cone(const LightBounds& a, const LightBounds& b) {
    double spread_a = angle_of(a.cos_spread), spread_b = angle_of(b.cos_spread);
    if (spread_b > spread_a) return merged_cone(b, a);
    double between = angle_of(glm::dot(a.axis, b.axis));
    if (std::min(between + spread_b, pi) <= spread_a) return {a.axis, a.cos_spread};
    double spread = 0.5 * (spread_a + between + spread_b);
    glm::dvec3 normal = glm::cross(a.axis, b.axis);
    double length = glm::length(normal);
    if (spread >= pi || length == 0.0) return {a.axis, -1.0};
    return {glm::normalize(turned(a.axis, normal / length, spread - spread_a)), std::cos(spread)};
}

/// Directions that a group shines into, weighted by the cosine beyond its axes: M_omega of Conty
/// Estevez and Kulla 2018.
double orientation_measure(const LightBounds& b) {
    double spread = angle_of(b.cos_spread), emission = angle_of(b.cos_emission);
    double reach = std::min(spread + emission, pi);
    double s = std::sin(spread), c = std::cos(spread);
    return 2.0 * pi * (1.0 - c) +
           0.5 * pi * (2.0 * reach * s - std::cos(spread - 2.0 * reach) - 2.0 * spread * s + c);
}

/// Square of the diagonal: unlike the surface area it does not vanish for lights in a row.
double extent_measure(const LightBounds& b) {
    glm::dvec3 d = b.high - b.low;
    return glm::dot(d, d);
}

using Range = std::span<int>;

struct Bin {
    std::optional<LightBounds> bounds;
    int count = 0;
    void add(const LightBounds& b, int n = 1) {
        bounds = bounds ? merge(*bounds, b) : b;
        count += n;
    }
    double cost() const {
        return bounds->power * orientation_measure(*bounds) * extent_measure(*bounds);
    }
};

class Builder {
public:
    Builder(std::span<const LightBounds> lights, LightChoice choice)
        : lights_(lights), by_power_(choice == LightChoice::power) {
        tree_.leaves.resize(lights.size());
    }

    LightTree build() {
        std::vector<int> order(lights_.size());
        std::iota(order.begin(), order.end(), 0);
        auto near_end = std::stable_partition(order.begin(), order.end(),
                                              [&](int i) { return !lights_[i].distant; });
        Range near(order.begin(), near_end), distant(near_end, order.end());
        if (near.empty() || distant.empty())
            add_pair(order, -1);
        else
            add_children(near, distant, -1);
        return std::move(tree_);
    }

private:
    /// Groups still to be cut in two, whose node is there already.
    struct Open {
        Range lights;
        int node;
    };

    void add_pair(Range lights, int parent) {
        auto [left, right] = cut(lights);
        add_children(left, right, parent);
    }

    /// Appends the two groups' nodes and everything below them. A list of what is left to do
    /// instead of recursion: equal lights make a chain as deep as they are many, not a stack.
    void add_children(Range left, Range right, int parent) {
        std::vector<Open> open;
        add_siblings(left, right, parent, open);
        while (!open.empty()) {
            Open o = open.back();
            open.pop_back();
            auto [a, b] = cut(o.lights);
            add_siblings(a, b, o.node, open);
        }
    }

    void add_siblings(Range left, Range right, int parent, std::vector<Open>& open) {
        int first = static_cast<int>(tree_.nodes.size());
        if (parent >= 0) tree_.nodes[parent].child = first;
        bool mixed = lights_[left[0]].distant != lights_[right[0]].distant;
        for (Range group : {left, right}) {
            int node = static_cast<int>(tree_.nodes.size());
            tree_.nodes.push_back(record(group, parent, mixed));
            if (group.size() > 1) {
                open.push_back({group, node});
            } else {
                tree_.nodes[node].child = ~group[0];
                tree_.leaves[group[0]] = node;
            }
        }
    }

    /// `mixed`: of two of which one has no place. What the other sends to a point is weighed
    /// against its irradiance there, which is the same everywhere.
    LightNodeRecord record(Range group, int parent, bool mixed) const {
        LightNodeRecord r{};
        r.parent = parent;
        r.fixed = by_power_ || lights_[group[0]].distant;
        if (r.fixed) {
            auto weight = mixed && !by_power_ ? &LightBounds::intensity : &LightBounds::power;
            double sum = 0.0;
            for (int i : group)
                sum += lights_[i].*weight;
            r.intensity = static_cast<float>(sum);
            return r;
        }
        LightBounds b = lights_[group[0]];
        for (int i : group.subspan(1))
            b = merge(b, lights_[i]);
        glm::dvec3 centre = 0.5 * (b.low + b.high);
        r.cx = static_cast<float>(centre.x), r.cy = static_cast<float>(centre.y),
        r.cz = static_cast<float>(centre.z);
        r.radius = static_cast<float>(0.5 * glm::length(b.high - b.low));
        r.ax = static_cast<float>(b.axis.x), r.ay = static_cast<float>(b.axis.y),
        r.az = static_cast<float>(b.axis.z);
        double reach = angle_of(b.cos_spread) + angle_of(b.cos_emission);
        r.spread = reach < pi ? -static_cast<float>(std::cos(reach)) : 2.0f;
        // Of lights that shine within less than a quarter turn (spots) the bound is small: scaled
        // up to their intensity on the axis.
        double on_axis = std::min(1.0 + r.spread, 1.0);
        r.intensity = static_cast<float>(b.intensity / on_axis);
        return r;
    }

    /// Two parts, neither empty: by the heuristic, or in the middle where it has nothing to go by.
    std::pair<Range, Range> cut(Range group) const {
        if (!lights_[group[0]].distant && !by_power_ && group.size() > 2)
            if (auto middle = best_cut(group))
                return {group.first(*middle), group.subspan(*middle)};
        std::size_t half = group.size() / 2;
        return {group.first(half), group.subspan(half)};
    }

    glm::dvec3 middle(int i) const { return 0.5 * (lights_[i].low + lights_[i].high); }

    std::optional<std::size_t> best_cut(Range group) const {
        constexpr int bins = 12;
        glm::dvec3 low(INFINITY), high(-INFINITY);
        for (int i : group)
            low = glm::min(low, middle(i)), high = glm::max(high, middle(i));
        glm::dvec3 extent = high - low;
        double longest = std::max({extent.x, extent.y, extent.z}), best = INFINITY;
        int best_axis = -1, best_bin = 0;
        auto bin_of = [&](int i, int axis) {
            double at = (middle(i)[axis] - low[axis]) / extent[axis];
            return std::min(static_cast<int>(at * bins), bins - 1);
        };
        for (int axis = 0; axis < 3; axis++) {
            if (!(extent[axis] > 0.0)) continue;
            std::array<Bin, bins> bin;
            for (int i : group)
                bin[bin_of(i, axis)].add(lights_[i]);
            for (int k = 1; k < bins; k++) {
                Bin left, right;
                for (int j = 0; j < bins; j++)
                    if (bin[j].count) (j < k ? left : right).add(*bin[j].bounds, bin[j].count);
                if (!left.count || !right.count) continue;
                // Thin slices are dear: the regulariser of the paper.
                double cost = longest / extent[axis] * (left.cost() + right.cost());
                if (cost < best) best = cost, best_axis = axis, best_bin = k;
            }
        }
        if (best_axis < 0) return {};
        auto end = std::stable_partition(group.begin(), group.end(),
                                         [&](int i) { return bin_of(i, best_axis) < best_bin; });
        return static_cast<std::size_t>(end - group.begin());
    }

    std::span<const LightBounds> lights_;
    bool by_power_;
    LightTree tree_;
};

} // namespace

LightBounds merge(const LightBounds& a, const LightBounds& b) {
    LightBounds m;
    m.low = glm::min(a.low, b.low), m.high = glm::max(a.high, b.high);
    std::tie(m.axis, m.cos_spread) = merged_cone(a, b);
    m.cos_emission = std::min(a.cos_emission, b.cos_emission);
    m.intensity = a.intensity + b.intensity;
    m.power = a.power + b.power;
    return m;
}

LightTree build_light_tree(std::span<const LightBounds> lights, LightChoice choice) {
    if (lights.size() < 2) return {};
    return Builder(lights, choice).build();
}

} // namespace parhelion
