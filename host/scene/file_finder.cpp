// Finding the files a scene names, and keeping a scene inside its own folder.
#include "host/scene/file_finder.h"

#include "host/scene/text.h"

#include <algorithm>
#include <fstream>
#include <utility>

namespace parhelion {

namespace fs = std::filesystem;

namespace {

bool is_below(const fs::path& path, const fs::path& folder) {
    const fs::path relative = path.lexically_relative(folder);
    return !relative.empty() && *relative.begin() != "..";
}

/// The folders of `candidates`, each once.
std::string looked_in(const std::vector<fs::path>& candidates) {
    std::vector<std::string> folders;
    for (const fs::path& candidate : candidates) {
        const fs::path folder = candidate.parent_path();
        const std::string name =
            in_quotes(folder.empty() ? "." : folder.lexically_normal().string());
        if (std::find(folders.begin(), folders.end(), name) == folders.end())
            folders.push_back(name);
    }
    std::string list;
    for (const std::string& folder : folders)
        list += (list.empty() ? " (looked in: " : ", ") + folder;
    return list + ")";
}

/// Of the other kind than was looked for.
std::string what_is_there(const std::vector<fs::path>& candidates) {
    for (const fs::path& candidate : candidates) {
        std::error_code error;
        const fs::file_type type = fs::status(candidate, error).type();
        if (type == fs::file_type::directory) return ": it is a folder";
        if (type == fs::file_type::regular) return ": it is a file";
        if (fs::exists(fs::file_status(type))) return ": it is neither a file nor a folder";
    }
    return "";
}

} // namespace

FileFinder::FileFinder(const fs::path& scene_file, bool allow_outside,
                       std::function<void(const std::string&)> check)
    : scene_folder_(scene_file.parent_path()), allow_outside_(allow_outside),
      check_(std::move(check)) {
    scene_root_ = fs::canonical(scene_folder_.empty() ? "." : scene_folder_);
}

fs::path FileFinder::find(const std::string& name, const SourceLocation& place,
                          bool want_folder) const {
    const char* const kind = want_folder ? "folder" : "file";
    if (name.empty()) refuse(place, std::string("empty ") + kind + " name");
    if (name.find('\0') != std::string::npos) refuse(place, "a file name cannot hold a zero byte");
    std::vector<fs::path> candidates;
    if (fs::path(name).is_absolute()) {
        candidates.emplace_back(name);
    } else {
        for (auto folder = folders_.rbegin(); folder != folders_.rend(); ++folder)
            candidates.push_back(*folder / name);
        candidates.push_back(scene_folder_ / name);
        candidates.push_back(fs::path(place.file).parent_path() / name);
    }
    for (const fs::path& candidate : candidates) {
        std::error_code error;
        const bool found = want_folder ? fs::is_directory(candidate, error)
                                       : fs::is_regular_file(candidate, error);
        if (!found) continue;
        const fs::path resolved = fs::canonical(candidate, error);
        if (error) continue;
        if (!allow_outside_ && !is_below(resolved, scene_root_))
            refuse(place,
                   std::string(kind) + " " + in_quotes(name) +
                       " lies outside the scene's folder (use --allow-outside to permit it)");
        return candidate;
    }
    refuse(place, std::string(kind) + " " + in_quotes(name) + " not found" +
                      what_is_there(candidates) + looked_in(candidates));
}

fs::path FileFinder::file(const std::string& name, const SourceLocation& place) const {
    fs::path path = find(name, place, false);
    if (check_) check_(path.string());
    found_.push_back(path.string());
    return path;
}

void FileFinder::add_folder(const std::string& name, const SourceLocation& place) {
    folders_.push_back(find(name, place, true));
}

std::string read_whole_file(const fs::path& path, const SourceLocation& place,
                            std::size_t max_bytes) {
    std::error_code error;
    const auto size = fs::file_size(path, error);
    if (error) refuse(place, "cannot read " + in_quotes(path.string()) + ": " + error.message());
    if (size > max_bytes)
        refuse(place, in_quotes(path.string()) + " holds " + std::to_string(size) +
                          " bytes (at most " + std::to_string(max_bytes) + " are accepted)");
    std::ifstream stream(path, std::ios::binary);
    std::string content(size, '\0');
    if (!stream.read(content.data(), static_cast<std::streamsize>(size)))
        refuse(place, "cannot read " + in_quotes(path.string()));
    return content;
}

} // namespace parhelion
