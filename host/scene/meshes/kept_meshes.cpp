// Meshes of files that several scenes of one process name: read and made once.
#include "host/scene/meshes/kept_meshes.h"

namespace parhelion {

std::string mesh_key(const std::string& how, const MeshOptions& options,
                     const SourceLocation& place) {
    const auto* const matrix = reinterpret_cast<const char*>(&options.to_world);
    return how + (options.face_normals ? " faces " : " ") +
           (options.flip_normals ? "flipped " : "") + place.to_string() + ' ' +
           std::string(matrix, sizeof options.to_world);
}

MadeMesh KeptMeshes::mesh(const std::filesystem::path& file, const std::string& key,
                          const std::function<MadeMesh()>& make) {
    const std::optional<FileStamp> stamp = file_stamp(file); // before it is read
    const std::pair name{file.string(), key};
    const auto known = meshes_.find(name);
    if (stamp && known != meshes_.end() && known->second.stamp == *stamp) {
        known->second.used = true;
        return *known->second.mesh;
    }
    if (known != meshes_.end()) meshes_.erase(known); // before there are two
    auto made = std::make_shared<const MadeMesh>(make());
    if (stamp) meshes_.emplace(name, Kept{*stamp, made});
    return *made;
}

void KeptMeshes::next_scene() {
    std::erase_if(meshes_, [](const auto& entry) { return !entry.second.used; });
    for (auto& [name, kept] : meshes_)
        kept.used = false;
}

} // namespace parhelion
