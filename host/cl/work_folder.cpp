// A folder of this process's own, which is gone when the process has ended.
#include "host/cl/work_folder.h"

#include "host/cl/folder_trial.h"
#include "host/cl/open_file.h"
#include "host/error.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <mutex>
#include <optional>
#include <string>

namespace parhelion {
namespace fs = std::filesystem;
namespace {

constexpr std::uint64_t enough_bytes = 8u << 20; ///< to compile all kernels: ten times a scene's
constexpr const char* driver_variable = "POCL_CACHE_DIR";
constexpr std::string_view name_start = "parhelion-work-";

std::string own_name_start() { return fmt::format("{}{}-", name_start, getpid()); }

/// The folder that the driver was told of, where this process has told it so.
std::optional<fs::path> told_folder() {
    const char* told = std::getenv(driver_variable);
    if (!told) return std::nullopt;
    fs::path folder = fs::path(told).parent_path();
    std::error_code ignored;
    if (!folder.filename().string().starts_with(own_name_start()) ||
        !fs::is_directory(folder, ignored))
        return std::nullopt;
    return folder;
}

void remove_told_folder() {
    std::error_code ignored;
    if (auto folder = told_folder()) fs::remove_all(*folder, ignored);
}

/// Its lock says that the process which made a folder still lives.
OpenFile locked(const fs::path& folder, int how) {
    OpenFile file(open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC | O_NOFOLLOW));
    if (file && flock(file.number(), how) != 0) return OpenFile(-1);
    return file;
}

bool is_mine(const fs::path& folder) {
    struct stat status {};
    return lstat(folder.c_str(), &status) == 0 && S_ISDIR(status.st_mode) &&
           status.st_uid == geteuid();
}

/// Work folders below `parent` whose processes have ended without removing them.
void remove_abandoned(const fs::path& parent) {
    std::error_code error;
    for (fs::directory_iterator entry(parent, error), end; !error && entry != end;
         entry.increment(error)) {
        if (!entry->path().filename().string().starts_with(name_start) || !is_mine(entry->path()))
            continue;
        std::error_code ignored;
        if (locked(entry->path(), LOCK_EX | LOCK_NB)) fs::remove_all(entry->path(), ignored);
    }
}

/// A new folder below `parent`, or nothing where another process takes it for abandoned.
std::optional<fs::path> made_below(const fs::path& parent) {
    std::string name = (parent / (own_name_start() + "XXXXXX")).string();
    if (!mkdtemp(name.data()))
        throw DeviceError(fmt::format("{}: {}", parent.string(), std::strerror(errno)));
    OpenFile lock = locked(name, LOCK_EX);
    std::error_code ignored;
    if (lock && !fs::exists(name, ignored)) return std::nullopt; // between its making and its lock
    lock.keep_open();
    return name;
}

std::vector<fs::path> usual_places() {
    std::vector<fs::path> places;
    if (const char* given = std::getenv("TMPDIR"); given && *given) places.emplace_back(given);
    places.insert(places.end(), {"/tmp", "/dev/shm", "/var/tmp"});
    return places;
}

std::string why_not(const fs::path& place) {
    std::error_code ignored;
    if (!fs::is_directory(place, ignored)) return "no such folder";
    std::string reason = why_not_writable(place, enough_bytes);
    if (reason.empty() && !may_hold_programs(place)) reason = "programs cannot be loaded from it";
    return reason;
}

fs::path make_work_folder(const std::vector<fs::path>& places) {
    std::string tried;
    for (const fs::path& place : places) {
        if (place.empty()) continue;
        std::string reason = why_not(place);
        if (reason.empty()) {
            remove_abandoned(place);
            for (;;)
                if (auto made = made_below(fs::absolute(place))) return *made;
        }
        tried += fmt::format("{}{} ({})", tried.empty() ? "" : ", ", place.string(), reason);
    }
    throw DeviceError(fmt::format("no folder to compile kernels in, which takes {} MB: tried {}; "
                                  "TMPDIR names another",
                                  enough_bytes >> 20, tried));
}

} // namespace

fs::path work_folder(const std::vector<fs::path>& others) {
    static std::mutex making; // the environment belongs to the process
    std::lock_guard lock(making);
    if (auto told = told_folder()) return *told;
    std::vector<fs::path> places = usual_places();
    if (const char* users = std::getenv(driver_variable)) places.emplace_back(users);
    for (const fs::path& other : others) {
        std::error_code ignored; // shows when it is tried
        fs::create_directories(other, ignored);
        places.push_back(other);
    }
    fs::path folder = make_work_folder(places);
    setenv(driver_variable, driver_folder(folder).c_str(), 1);
    std::atexit(remove_told_folder);
    return folder;
}

fs::path driver_folder(const fs::path& work_folder) { return work_folder / "driver"; }
fs::path spare_cache_folder(const fs::path& work_folder) { return work_folder / "programs"; }

} // namespace parhelion
