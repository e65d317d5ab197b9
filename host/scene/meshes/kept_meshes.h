// Mesh files that several scenes of one process name: read once.
#pragma once

#include "host/file_stamp.h"
#include "host/scene/meshes/mesh_serialized.h"

#include <functional>
#include <map>
#include <memory>
#include <string>
#include <utility>

namespace parhelion {

class KeptMeshes {
public:
    /// The mesh of a file that is read in the way that `how` names ("ply", with its options): what
    /// `read` makes of it, or made of it before where the file has not changed since.
    SerializedMesh mesh(const std::filesystem::path& file, const std::string& how,
                        const std::function<SerializedMesh()>& read);

    /// Another scene begins: what the last one had no use for goes, so that a mesh a frame takes no
    /// more memory than one.
    void next_scene();

private:
    struct Kept {
        FileStamp stamp;
        std::shared_ptr<const SerializedMesh> mesh;
        bool used = true; ///< by this scene
    };
    std::map<std::pair<std::string, std::string>, Kept> meshes_; ///< by file and how
};

} // namespace parhelion
