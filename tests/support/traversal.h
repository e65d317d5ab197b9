// The rays of numerics through the kernels, for the device tests: in every way to compile them.
#pragma once

#include "host/numerics/traversal.h"
#include "tests/support/device.h"

namespace parhelion::test {

using TestRay = numerics::TracedRay;
using TestHit = numerics::TracedHit;

struct Traversal : numerics::Traversal {
    Traversal(const TestDevice& d, const Variant& variant,
              const FeatureSet& features = FeatureSet::all())
        : numerics::Traversal(d, {variant.lanes, features, variant.portable}) {}
};

} // namespace parhelion::test
