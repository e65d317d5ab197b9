// How much memory the records of a scene take, before they are made.
#pragma once

#include "host/scene/scene.h"

#include <cstdint>

namespace parhelion {

/// What making them takes at most beside the scene, bytes. Of geometry it is a measured bound for
/// a primitive (2 million triangles of a mesh took 130 bytes each at their worst, with the tree
/// while it is built); of images it is their texels, which are all that is read of them.
std::uint64_t most_flattened_bytes(const Scene& scene);

} // namespace parhelion
