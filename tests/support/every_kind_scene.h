// The stress test's scene of every kind.
#pragma once

#include "host/stress/every_kind_scene.h"

namespace parhelion::test {

using namespace parhelion::stress;

} // namespace parhelion::test
