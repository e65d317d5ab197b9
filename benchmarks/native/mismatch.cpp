// Where two tracers disagree: ties at edges told apart from mistakes, by double precision.
#include "benchmarks/native/mismatch.h"

#include "host/numerics/triangle_truth.h"

#include <algorithm>
#include <cmath>

namespace parhelion::bench {
namespace {

/// A triangle met in double: distance along the ray, the smallest barycentric, and how much a
/// rounding error of the coordinates moves the distance, as a share of it.
struct Meeting {
    double t, inside, sensitivity;
};

Meeting meet(const PrimitiveRecord& p, const Ray& r) {
    numerics::PlaneMeeting m = numerics::plane_meeting(p, r);
    double corner = std::hypot(p.ax, p.ay, p.az);
    return {m.t, m.inside, m.normal * (m.to_corner + corner) / std::fabs(m.height)};
}

constexpr double rounding = 1e-4; ///< of a barycentric, for each unit of sensitivity
constexpr double distance_rounding = 32 * 0x1p-24;

/// How clearly the ray meets the triangle before its end (positive) or misses it (negative), in
/// units of rounding; within [-1, 1] single precision cannot tell.
double clearness(const PrimitiveRecord& p, const Ray& r) {
    Meeting m = meet(p, r);
    if (!std::isfinite(m.t) || !std::isfinite(m.inside)) return -INFINITY; // no area, or edge on
    double step = distance_rounding * m.sensitivity * std::fabs(m.t);
    double clear = std::min(m.inside / (rounding * m.sensitivity), m.t / step);
    return std::isinf(r.t_max) ? clear : std::min(clear, (r.t_max - m.t) / step);
}

/// Through all triangles: whether the ray is clearly blocked (above 1), clearly free (below -1).
double blocked_clearness(std::span<const PrimitiveRecord> primitives, const Ray& r) {
    double most = -INFINITY;
    for (std::size_t i = 0; i < primitives.size(); i++)
        if (static_cast<int>(i) != r.excluded) most = std::max(most, clearness(primitives[i], r));
    return most;
}

class Judge {
public:
    explicit Judge(std::span<const PrimitiveRecord> primitives) : primitives_(primitives) {}

    /// Takes a ray for which the answers differ into the counts.
    void closest(const Ray& r, const Hit& ours, const Hit& theirs) {
        counts_.differ++;
        double clear_ours = ours.primitive < 0 ? INFINITY : clearness(at(ours), r);
        double clear_theirs = theirs.primitive < 0 ? INFINITY : clearness(at(theirs), r);
        bool edge = std::fabs(clear_ours) <= 1 || std::fabs(clear_theirs) <= 1;
        bool both =
            ours.primitive >= 0 && theirs.primitive >= 0 && clear_ours > 0 && clear_theirs > 0;
        if (edge || (both && same_distance(r, ours, theirs))) {
            counts_.ties++;
            return;
        }
        // What is not met at all is wrong; of two that are met, the farther one.
        bool wrong = clear_ours < 0 || (clear_theirs > 0 && farther(r, ours, theirs));
        (wrong ? counts_.ours_wrong : counts_.theirs_wrong)++;
    }

    void any(const Ray& r, const Hit& ours) {
        counts_.differ++;
        double clear = blocked_clearness(primitives_, r);
        if (std::fabs(clear) <= 1)
            counts_.ties++;
        else
            ((clear > 0) != (ours.primitive >= 0) ? counts_.ours_wrong : counts_.theirs_wrong)++;
    }

    const Mismatches& counts() const { return counts_; }

private:
    const PrimitiveRecord& at(const Hit& h) const {
        return primitives_[static_cast<std::size_t>(h.primitive)];
    }
    bool same_distance(const Ray& r, const Hit& a, const Hit& b) const {
        Meeting x = meet(at(a), r), y = meet(at(b), r);
        return std::fabs(x.t - y.t) <=
               distance_rounding * std::max(x.sensitivity, y.sensitivity) * std::fabs(y.t);
    }
    /// A miss is farther than anything.
    bool farther(const Ray& r, const Hit& a, const Hit& b) const {
        if (b.primitive < 0) return false;
        return a.primitive < 0 || meet(at(a), r).t > meet(at(b), r).t;
    }

    std::span<const PrimitiveRecord> primitives_;
    Mismatches counts_;
};

} // namespace

Mismatches count_mismatches(std::span<const PrimitiveRecord> primitives, std::span<const Ray> rays,
                            std::span<const Hit> ours, std::span<const Hit> theirs, bool any_hit) {
    Judge judge(primitives);
    for (std::size_t i = 0; i < rays.size(); i++) {
        if (any_hit) {
            if ((ours[i].primitive < 0) != (theirs[i].primitive < 0)) judge.any(rays[i], ours[i]);
        } else if (ours[i].primitive != theirs[i].primitive) {
            judge.closest(rays[i], ours[i], theirs[i]);
        }
    }
    return judge.counts();
}

} // namespace parhelion::bench
