// What the stress test measures with, for the unit tests.
#pragma once

#include "host/stress/measure.h"

namespace parhelion::test {

using namespace parhelion::stress;

} // namespace parhelion::test
