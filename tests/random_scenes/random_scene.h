// Scenes drawn at random, as a user could have written them: XML and OBJ files.
#pragma once

#include <cstdint>
#include <string>

namespace parhelion::test {

/// `small`: a few objects of ordinary numbers. `extreme`: numbers from all that floats have, shapes
/// without extent, needles, lights of no power and of far too much.
enum class SceneKind { small, extreme };

struct RandomScene {
    std::string xml; ///< names mesh_file_name, in its own folder
    std::string obj;
};

inline constexpr const char* mesh_file_name = "mesh.obj";

/// The same for the same kind and seed on every machine.
RandomScene random_scene(SceneKind kind, std::uint64_t seed);

} // namespace parhelion::test
