// Wavefront OBJ meshes.
#include "host/scene/meshes/mesh_obj.h"
#include "property.h"
#include "targets.h"

int parhelion::fuzz::fuzz_obj(const std::uint8_t* data, std::size_t size) {
    return answer_or_refusal(
        [&] { check_mesh_data(parse_obj(std::string(as_text(data, size)), true, "mesh.obj")); });
}
