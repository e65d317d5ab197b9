// A folder of this process's own, which is gone when the process has ended.
#pragma once

#include <filesystem>
#include <vector>

namespace parhelion {

/// Where the driver compiles, and where programs are kept that the cache has no room for. The
/// driver's own cache is not used: it believes damaged files, writes files that other processes
/// read, and grows without bound. What it made is kept by ProgramCache, with checksums.
///
/// Made by the first call, which must come before the first call of OpenCL: PoCL is told of it by
/// POCL_CACHE_DIR and asks once. In TMPDIR, else /tmp, /dev/shm, /var/tmp, else one of `others`:
/// where a file can be written, space is left and programs can be loaded. What processes that were
/// killed have left there is removed. Throws DeviceError that names what was tried.
std::filesystem::path work_folder(const std::vector<std::filesystem::path>& others);

/// Below it, for the driver alone.
std::filesystem::path driver_folder(const std::filesystem::path& work_folder);
/// Below it: programs that the cache has no room for.
std::filesystem::path spare_cache_folder(const std::filesystem::path& work_folder);

} // namespace parhelion
