// Programs that a driver keeps in its folder itself (PoCL: XX/YYY.../, with the program and a
// shared object for each kernel and size of work-group), as bytes for the cache.
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <set>
#include <string>
#include <vector>

namespace parhelion {

/// One program in the driver's folder, which this process alone uses. Copies are of one program.
/// To ask the driver for a binary instead would make it compile every kernel once more.
class DriverProgram {
public:
    explicit DriverProgram(const std::string& key);

    /// Puts there what packed() once gave; whether that could be.
    bool restore(const std::vector<unsigned char>& packed);
    /// Runs `build`, and finds the program's folder by what is new. Whether something was.
    bool watch(const std::function<void()>& build);
    /// All that the driver has of it by now. Empty where it has nothing or a file is unreadable.
    std::vector<unsigned char> packed() const;

    /// Whether the driver has no more than was restored or stored.
    bool is_stored() const { return *stored_ == files(); }
    void set_stored() const { *stored_ = files(); }

private:
    std::vector<std::string> files() const; ///< relative to the driver's folder

    std::filesystem::path driver_, names_; ///< names_: its folders, for a second build of it
    std::set<std::string> folders_;        ///< relative to the driver's folder
    std::shared_ptr<std::vector<std::string>> stored_;
};

} // namespace parhelion
