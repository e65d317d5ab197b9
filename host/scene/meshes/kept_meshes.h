// Meshes of files that several scenes of one process name: read and made once.
#pragma once

#include "host/file_stamp.h"
#include "host/scene/meshes/mesh_serialized.h"

#include <functional>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace parhelion {

/// A mesh of the scene, and what was noted when it was made.
struct MadeMesh {
    Mesh mesh;
    std::vector<std::string> notes;
};

/// All that a mesh depends on besides the bytes of its file, as text: how it is read, where it is
/// put, and the place that notes name.
std::string mesh_key(const std::string& how, const MeshOptions& options,
                     const SourceLocation& place);

class KeptMeshes {
public:
    /// What `make` makes of the file, or made of it before, for the same key, where the file has
    /// not changed since. Throws what that throws.
    MadeMesh mesh(const std::filesystem::path& file, const std::string& key,
                  const std::function<MadeMesh()>& make);

    /// Another scene begins: what the last one had no use for goes, so that a mesh a frame takes no
    /// more memory than one.
    void next_scene();

private:
    struct Kept {
        FileStamp stamp;
        std::shared_ptr<const MadeMesh> mesh;
        bool used = true; ///< by this scene
    };
    std::map<std::pair<std::string, std::string>, Kept> meshes_; ///< by file and key
};

} // namespace parhelion
