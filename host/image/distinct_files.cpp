// Files that a command must not mistake for each other.
#include "host/image/distinct_files.h"

#include "host/error.h"
#include "host/image/output.h"

#include <filesystem>
#include <map>
#include <sys/stat.h>
#include <tuple>

namespace parhelion {
namespace {

/// Of a file that exists, itself; of another, its folder and its name there.
using Identity = std::tuple<dev_t, ino_t, std::string>;

Identity identity_of(const std::string& file) {
    struct stat status {};
    if (::stat(file.c_str(), &status) == 0) return {status.st_dev, status.st_ino, ""};
    const std::filesystem::path target(followed_links(file));
    const std::string folder = target.has_parent_path() ? target.parent_path().string() : ".";
    if (::stat(folder.c_str(), &status) != 0) return {0, 0, target.string()};
    return {status.st_dev, status.st_ino, target.filename().string()};
}

} // namespace

void check_distinct(const std::vector<UsedFile>& outputs, const std::vector<UsedFile>& inputs) {
    std::map<Identity, const UsedFile*> known;
    for (const UsedFile& input : inputs)
        if (!input.name.empty()) known.emplace(identity_of(input.name), &input);
    for (const UsedFile& output : outputs) {
        if (output.name.empty()) continue;
        const auto [other, is_new] = known.emplace(identity_of(output.name), &output);
        if (!is_new)
            throw InputError(output.role + " " + output.name + ": is the same file as " +
                             other->second->role + " " + other->second->name);
    }
}

} // namespace parhelion
