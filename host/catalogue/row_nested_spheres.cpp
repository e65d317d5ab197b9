// Two spheres whose radii differ by 4e-6: the nearer one is hit, from inside and from outside.
#include "host/catalogue/ray_rows.h"

namespace parhelion::stress {

Checks row_nested_spheres(StressRun& run) {
    Traversal& traversal = run.traversal();
    rays::Primitives spheres{rays::sphere({0, 0, 0}, 1), rays::sphere({0, 0, 0}, 1 + 4e-6f)};
    traversal.upload(spheres);
    Random random(run.seed);
    Checks checks;
    for (bool inside : {true, false}) {
        auto ray = [&](std::uint64_t) {
            f64::vec3 at = f64::scale3(random.direction<F64>(),
                                       inside ? 0.9 * random.unit() : random.between(1.5, 4));
            f64::vec3 aim = f64::scale3(random.direction<F64>(), inside ? 2 : 0.9);
            f32::vec3 o = vec_as<F32>(at), d = vec_as<F32>(f64::normalize3(f64::sub3(aim, at)));
            return TracedRay{vector_of(o), vector_of(d)};
        };
        std::uint64_t count = run.count(20'000, 1'000'000, 20'000'000), wrong = 0;
        in_batches(count, ray, [&](const std::vector<TracedRay>& list) {
            for (const TracedHit& hit : traversal.closest(list))
                wrong += hit.primitive != (inside ? 0 : 1);
        });
        checks.push_back(
            rays_check(inside ? "radius 1 within 1 + 4e-6: not the inner one from inside"
                              : "radius 1 within 1 + 4e-6: not the outer one from outside",
                       wrong, count));
    }
    checks.push_back(host_check("radius 1 within 1 + 4e-6", traversal));
    return checks;
}

} // namespace parhelion::stress
