// The stress test's rays through the kernels, for the device tests: in every way to compile them.
#pragma once

#include "host/stress/traversal.h"
#include "tests/support/device.h"

namespace parhelion::test {

using TestRay = stress::TracedRay;
using TestHit = stress::TracedHit;

struct Traversal : stress::Traversal {
    Traversal(const TestDevice& d, const Variant& variant,
              const FeatureSet& features = FeatureSet::all())
        : stress::Traversal(d, {variant.lanes, features, variant.portable}) {}
};

} // namespace parhelion::test
