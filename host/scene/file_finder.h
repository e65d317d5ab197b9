// Finding the files a scene names, and keeping a scene inside its own folder.
#pragma once

#include "host/error.h"

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace parhelion {

/// Where relative names are looked for. The most recently added folder is tried first, then the
/// scene's folder, then the folder of the file that names them.
class FileFinder {
public:
    /// `scene_file` exists. With `allow_outside` files beyond the scene's folder may be used.
    /// `check`, where there is one, throws InputError for those that may not.
    FileFinder(const std::filesystem::path& scene_file, bool allow_outside,
               std::function<void(const std::string&)> check = {});

    /// The existing regular file called `name` by the scene at `place`.
    /// Throws InputError when there is none, or when it leaves the scene's folder without leave.
    std::filesystem::path file(const std::string& name, const SourceLocation& place) const;

    /// What `file` has found so far.
    const std::vector<std::string>& found() const { return found_; }

    /// Adds a folder to look in; throws like `file`.
    void add_folder(const std::string& name, const SourceLocation& place);

private:
    std::filesystem::path find(const std::string& name, const SourceLocation& place,
                               bool want_folder) const;

    std::filesystem::path scene_folder_;
    std::filesystem::path scene_root_; ///< scene_folder_ with links resolved
    std::vector<std::filesystem::path> folders_;
    bool allow_outside_;
    std::function<void(const std::string&)> check_;
    mutable std::vector<std::string> found_;
};

/// The whole file; throws InputError naming `path` when it cannot be read or exceeds `max_bytes`.
std::string read_whole_file(const std::filesystem::path& path, const SourceLocation& place,
                            std::size_t max_bytes);

} // namespace parhelion
