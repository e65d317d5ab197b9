// Programs that a driver keeps in its folder itself.
#include "host/cl/driver_programs.h"

#include "host/cl/packed_files.h"
#include "host/cl/program_file.h"
#include "host/cl/work_folder.h"

#include <algorithm>
#include <fstream>
#include <iterator>

namespace parhelion {
namespace fs = std::filesystem;
namespace {

using Folders = std::set<std::string>;

std::vector<fs::path> folders_in(const fs::path& folder) {
    std::vector<fs::path> found;
    std::error_code error;
    for (fs::directory_iterator entry(folder, error), end; !error && entry != end;
         entry.increment(error)) {
        std::error_code gone;
        if (entry->is_directory(gone)) found.push_back(entry->path());
    }
    return found;
}

/// Of all programs.
Folders program_folders(const fs::path& driver) {
    Folders found;
    for (const fs::path& outer : folders_in(driver))
        for (const fs::path& inner : folders_in(outer))
            found.insert((outer.filename() / inner.filename()).string());
    return found;
}

Folders folders_of(const std::vector<std::string>& files) {
    Folders folders;
    for (const std::string& file : files) {
        fs::path inner = file;
        while (std::distance(inner.begin(), inner.end()) > 2)
            inner = inner.parent_path();
        folders.insert(inner.string());
    }
    return folders;
}

Folders read_names(const fs::path& file) {
    std::ifstream in(file);
    return {std::istream_iterator<std::string>(in), {}};
}

void write_names(const fs::path& file, const Folders& folders) {
    std::ofstream out(file);
    std::copy(folders.begin(), folders.end(), std::ostream_iterator<std::string>(out, "\n"));
}

/// The driver touches it when it looks at a program.
constexpr const char* bookkeeping = "last_accessed";

} // namespace

DriverProgram::DriverProgram(const std::string& key)
    : driver_(driver_folder(work_folder({}))),
      names_(work_folder({}) / (program_file_name(key) + ".folders")), folders_(read_names(names_)),
      stored_(std::make_shared<std::vector<std::string>>()) {}

bool DriverProgram::restore(const std::vector<unsigned char>& packed) {
    auto restored = unpack_files(packed, driver_);
    if (!restored) return false;
    folders_.merge(folders_of(*restored));
    *stored_ = std::move(*restored);
    return true;
}

bool DriverProgram::watch(const std::function<void()>& build) {
    const Folders before = program_folders(driver_);
    build();
    const Folders after = program_folders(driver_);
    Folders made;
    std::set_difference(after.begin(), after.end(), before.begin(), before.end(),
                        std::inserter(made, made.end()));
    if (made.empty()) return false;
    folders_ = std::move(made); // what was restored is not what the driver asked for
    write_names(names_, folders_);
    return true;
}

std::vector<std::string> DriverProgram::files() const {
    std::vector<std::string> found;
    for (const std::string& folder : folders_) {
        std::error_code error;
        for (fs::recursive_directory_iterator entry(driver_ / folder, error), end;
             !error && entry != end; entry.increment(error)) {
            std::error_code gone;
            if (entry->is_regular_file(gone) && entry->path().filename() != bookkeeping)
                found.push_back(entry->path().lexically_relative(driver_).string());
        }
    }
    std::sort(found.begin(), found.end());
    return found;
}

std::vector<unsigned char> DriverProgram::packed() const {
    return pack_files(driver_, files()).value_or(std::vector<unsigned char>{});
}

} // namespace parhelion
