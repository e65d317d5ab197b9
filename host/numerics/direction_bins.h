// A partition of the sphere fitted to samples: cells of about equal count, for chi-square tests of
// sharp densities.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "host/numerics/measure.h"
#include "host/numerics/quadrature.h"

namespace parhelion::numerics {

/// Each hemisphere in the coordinates (1 - |z|, azimuth), whose area is solid angle: a k-d tree of
/// medians. So cells are small where the density is high, the horizon is a border, and the density
/// is resolved everywhere.
class DirectionBins {
public:
    /// Halvings of a cell's sides: 9 lose 6e-5 of a lobe of roughness 1e-3 seen at 89.9 degrees.
    static constexpr int deepest = 12;

    /// pilot: samples that are not counted later; leaf: the fewest of them worth a cell of their
    /// own.
    DirectionBins(const std::vector<f32::vec3>& pilot, std::size_t leaf) {
        std::vector<Point> upper, lower;
        for (f32::vec3 w : pilot)
            (w.z > 0 ? upper : lower).push_back(point(wide(w)));
        root_[0] = build(upper, {0, 1, -M_PI, M_PI}, 1, leaf);
        root_[1] = build(lower, {0, 1, -M_PI, M_PI}, -1, leaf);
    }

    std::size_t size() const { return cells_.size(); }

    std::size_t find(f64::vec3 w) const {
        Point p = point(w);
        std::size_t n = root_[w.z > 0 ? 0 : 1];
        while (nodes_[n].axis >= 0)
            n = (nodes_[n].axis == 0 ? p.x : p.y) < nodes_[n].split ? nodes_[n].low
                                                                    : nodes_[n].high;
        return nodes_[n].low;
    }

    /// Integral of density(direction) over a cell, in solid angle.
    template<class F>
    double mass(std::size_t cell, const F& density, double tolerance, int certain = deepest) const {
        double side = cells_[cell].side;
        auto f = [&](double x, double phi) {
            double sine = std::sqrt(x * (2 - x));
            return double(
                density(f64::v3(sine * std::cos(phi), sine * std::sin(phi), side * (1 - x))));
        };
        const Rectangle &box = cells_[cell].box, &core = cells_[cell].core;
        std::vector<double> x = graded(box.x0, core.x0, core.x1, box.x1),
                            y = graded(box.y0, core.y0, core.y1, box.y1);
        double sum = 0;
        for (std::size_t i = 0; i + 1 < x.size(); i++)
            for (std::size_t j = 0; j + 1 < y.size(); j++)
                sum += integrate(f, {x[i], x[i + 1], y[j], y[j + 1]}, tolerance, deepest, certain);
        return sum;
    }

private:
    struct Point {
        double x, y;
    };
    struct Cell {
        Rectangle box, core; // core: where its pilot samples lie
        double side;
    };
    struct Node {
        int axis; // -1: a leaf, whose cell is `low`
        double split;
        std::size_t low, high;
    };

    static Point point(f64::vec3 w) {
        return {(w.x * w.x + w.y * w.y) / (1 + std::fabs(w.z)), std::atan2(w.y, w.x)};
    }

    static Rectangle core_of(const std::vector<Point>& points, const Rectangle& box) {
        if (points.empty()) return box;
        Rectangle core = {points[0].x, points[0].x, points[0].y, points[0].y};
        for (const Point& p : points) {
            core.x0 = std::min(core.x0, p.x), core.x1 = std::max(core.x1, p.x);
            core.y0 = std::min(core.y0, p.y), core.y1 = std::max(core.y1, p.y);
        }
        return core;
    }

    /// Break points from low to high, finest about the core: the tails of a sharp density start at
    /// its borders.
    static std::vector<double> graded(double low, double core_low, double core_high, double high) {
        double width = core_high - core_low;
        if (!(width > 0)) return {low, high};
        std::vector<double> breaks;
        if (core_low - low < width) core_low = low;
        if (high - core_high < width) core_high = high;
        for (double step = width; core_low - low > step; step *= 16)
            breaks.insert(breaks.begin(), core_low - step);
        if (core_low > low) breaks.insert(breaks.begin(), low);
        breaks.push_back(core_low);
        breaks.push_back(core_high);
        for (double step = width; high - core_high > step; step *= 16)
            breaks.push_back(core_high + step);
        if (core_high < high) breaks.push_back(high);
        return breaks;
    }

    /// Width of the middle half of the points along an axis: the smaller, the more there is to
    /// resolve.
    static double middle_half(const std::vector<Point>& points, double Point::*coordinate) {
        std::vector<double> values;
        values.reserve(points.size());
        for (const Point& p : points)
            values.push_back(p.*coordinate);
        auto quarter = std::ptrdiff_t(values.size() / 4);
        std::nth_element(values.begin(), values.begin() + quarter, values.end());
        double low = values[std::size_t(quarter)];
        std::nth_element(values.begin(), values.end() - 1 - quarter, values.end());
        return *(values.end() - 1 - quarter) - low;
    }

    std::size_t build(std::vector<Point>& points, Rectangle box, double side, std::size_t leaf) {
        std::size_t index = nodes_.size();
        nodes_.push_back({-1, 0, cells_.size(), 0});
        int axis = -1;
        if (points.size() >= 2 * leaf) {
            double x = middle_half(points, &Point::x) / (box.x1 - box.x0);
            axis = x < middle_half(points, &Point::y) / (box.y1 - box.y0) ? 0 : 1;
        }
        if (axis < 0) {
            cells_.push_back({box, core_of(points, box), side});
            return index;
        }
        auto middle = points.begin() + std::ptrdiff_t(points.size() / 2);
        std::nth_element(points.begin(), middle, points.end(),
                         [&](Point a, Point b) { return axis == 0 ? a.x < b.x : a.y < b.y; });
        double split = axis == 0 ? middle->x : middle->y;
        std::vector<Point> low(points.begin(), middle), high(middle, points.end());
        Rectangle low_box = box, high_box = box;
        (axis == 0 ? low_box.x1 : low_box.y1) = split;
        (axis == 0 ? high_box.x0 : high_box.y0) = split;
        std::size_t low_node = build(low, low_box, side, leaf);
        std::size_t high_node = build(high, high_box, side, leaf);
        nodes_[index] = {axis, split, low_node, high_node};
        return index;
    }

    std::vector<Node> nodes_;
    std::vector<Cell> cells_;
    std::size_t root_[2];
};

} // namespace parhelion::numerics
