// Mesh files that several scenes of one process name: read once.
#include "host/scene/meshes/kept_meshes.h"

namespace parhelion {

SerializedMesh KeptMeshes::mesh(const std::filesystem::path& file, const std::string& how,
                                const std::function<SerializedMesh()>& read) {
    const std::optional<FileStamp> stamp = file_stamp(file); // before it is read
    const std::pair key{file.string(), how};
    const auto known = meshes_.find(key);
    if (stamp && known != meshes_.end() && known->second.stamp == *stamp) {
        known->second.used = true;
        return *known->second.mesh;
    }
    auto mesh = std::make_shared<const SerializedMesh>(read());
    if (stamp) meshes_.insert_or_assign(key, Kept{*stamp, mesh});
    return *mesh;
}

void KeptMeshes::next_scene() {
    std::erase_if(meshes_, [](const auto& entry) { return !entry.second.used; });
    for (auto& [key, kept] : meshes_)
        kept.used = false;
}

} // namespace parhelion
