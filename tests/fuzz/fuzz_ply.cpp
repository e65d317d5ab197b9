// Stanford PLY meshes, text and binary.
#include "host/scene/meshes/mesh_ply.h"
#include "property.h"
#include "targets.h"

int parhelion::fuzz::fuzz_ply(const std::uint8_t* data, std::size_t size) {
    return answer_or_refusal(
        [&] { check_mesh_data(parse_ply(as_text(data, size), true, "mesh.ply")); });
}
