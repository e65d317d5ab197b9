// Why there is no OpenCL device: the loader tells no more than that it found no platform, so the
// files that register drivers are read again here.
#include "host/cl/no_device.h"

#include "host/cl/driver_watch.h"

#include <dlfcn.h>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>

namespace parhelion {
namespace fs = std::filesystem;
namespace {

constexpr const char* install = "on a CPU, install pocl-opencl-icd";

/// Where the loader (ocl-icd) looks: a folder of .icd files, or one file.
fs::path registry() {
    for (const char* variable : {"OCL_ICD_VENDORS", "OPENCL_VENDOR_PATH"})
        if (const char* given = std::getenv(variable); given && *given) return given;
    return "/etc/OpenCL/vendors";
}

std::vector<fs::path> registered(const fs::path& place) {
    std::error_code error;
    if (!fs::is_directory(place, error)) return {place};
    std::vector<fs::path> files;
    for (fs::directory_iterator entry(place, error), end; !error && entry != end;
         entry.increment(error))
        if (entry->path().extension() == ".icd") files.push_back(entry->path());
    std::sort(files.begin(), files.end());
    return files;
}

/// What the first line of an .icd file names; a library may be given itself.
std::string library_of(const fs::path& file) {
    if (file.extension() != ".icd") return file.string();
    std::ifstream in(file);
    std::string line;
    std::getline(in, line);
    return line;
}

/// Why the library of an .icd file is of no use, or nothing.
std::string why_not_loaded(const fs::path& file) {
    std::string library = library_of(file);
    if (library.empty()) return fmt::format("{} cannot be read or names no library", file.string());
    if (dlopen(library.c_str(), RTLD_LAZY | RTLD_LOCAL)) return {}; // to the end: it is a driver
    const char* reason = dlerror();
    return fmt::format("{} of {} cannot be loaded: {}", library, file.string(),
                       reason ? reason : "no reason given");
}

std::string why_no_platform(const std::string& failure) {
    const fs::path place = registry();
    std::vector<fs::path> files = registered(place);
    std::error_code ignored;
    if (files.empty() || !fs::exists(place, ignored))
        return fmt::format("no driver is registered in {} ({})", place.string(), install);
    std::vector<std::string> reasons;
    for (const fs::path& file : files)
        if (std::string reason = why_not_loaded(file); !reason.empty()) reasons.push_back(reason);
    if (reasons.empty()) reasons.push_back(failure);
    return fmt::format("{}", fmt::join(reasons, "; "));
}

} // namespace

std::string why_no_device(const DeviceList& list) {
    std::string why = list.platforms == 0
                          ? why_no_platform(list.failures.empty() ? "the loader finds no platform"
                                                                  : list.failures.front())
                          : fmt::format("{}", fmt::join(list.failures, "; "));
    return "no OpenCL device: " + why + memory_limit_text();
}

} // namespace parhelion
