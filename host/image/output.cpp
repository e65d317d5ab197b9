// Output checks, unfinished files and the one step that publishes a finished one.
#include "host/image/output.h"

#include "host/error.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <fcntl.h>
#include <filesystem>
#include <fstream>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>
#include <utility>

namespace parhelion {

namespace fs = std::filesystem;

namespace {

constexpr std::array<std::pair<const char*, ImageFormat>, 2> formats{
    {{".exr", ImageFormat::exr}, {".png", ImageFormat::png}}};
constexpr int most_links = 40; ///< as many as the system follows
constexpr int most_names = 1000;

std::string accepted_extensions() {
    std::string list;
    for (const auto& format : formats)
        list += (list.empty() ? "" : " or ") + std::string(format.first);
    return list;
}

fs::path folder_of(const std::string& file) {
    const fs::path parent = fs::path(file).parent_path();
    return parent.empty() ? fs::path(".") : parent;
}

[[noreturn]] void fail(const std::string& file, const std::string& what, int error) {
    throw OutputError(file + ": " + what + ": " + std::strerror(error));
}

/// Renames a file unless the new name is taken; 0 or the error's number.
int rename_if_free(const std::string& from, const std::string& to) {
    if (::renameat2(AT_FDCWD, from.c_str(), AT_FDCWD, to.c_str(), RENAME_NOREPLACE) == 0) return 0;
    if (errno != EINVAL && errno != ENOSYS) return errno;
    // A file system that cannot do that in one step, as NFS.
    if (::link(from.c_str(), to.c_str()) != 0) return errno;
    ::unlink(from.c_str());
    return 0;
}

bool has_links(int descriptor) {
    struct stat status {};
    return ::fstat(descriptor, &status) == 0 && status.st_nlink > 0;
}

} // namespace

ImageFormat image_format(const std::string& file) {
    std::string extension = fs::path(file).extension().string();
    std::transform(extension.begin(), extension.end(), extension.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    for (const auto& [name, format] : formats)
        if (extension == name) return format;
    throw InputError(file + ": an output file must end in " + accepted_extensions());
}

void check_output(const std::string& file, bool force) {
    image_format(file);
    check_output_file(file, force);
}

std::string followed_links(const std::string& file) {
    fs::path path = file;
    std::error_code error;
    for (int i = 0; i < most_links; ++i) {
        if (!fs::is_symlink(fs::symlink_status(path, error))) return path.string();
        path = path.parent_path() / fs::read_symlink(path, error); // an absolute one replaces all
        if (error) break;
    }
    throw InputError(file + ": a symbolic link that leads nowhere");
}

std::string folder_of_output(const std::string& file) {
    return folder_of(followed_links(file)).string();
}

void check_folder(const std::string& who, const std::string& folder) {
    std::error_code error;
    if (!fs::is_directory(folder, error))
        throw InputError(who + ": the folder " + folder + " does not exist");
    if (::access(folder.c_str(), W_OK | X_OK) != 0)
        throw InputError(who + ": the folder " + folder + " is not writable");
}

void check_output_file(const std::string& file, bool force) {
    if (file == "-")
        throw InputError(
            "-: an output is a file, not standard output (./- is a file of that name)");
    std::error_code error;
    const fs::file_status status = fs::status(file, error); // before links of /proc are followed
    if (fs::exists(status) && !fs::is_regular_file(status))
        throw InputError(file + ": exists and is not a regular file");
    const std::string target = followed_links(file);
    check_folder(file, folder_of(target).string());
    if (force) return;
    if (fs::exists(status)) throw InputError(file + ": exists; give --force to replace it");
    if (target != file)
        throw InputError(file + ": is a symbolic link to " + target +
                         ", which does not exist; give --force to write that");
}

void write_text_file(const std::string& file, const std::string& text, Existing existing) {
    PendingFile pending(file, existing);
    std::ofstream out(pending.temporary_name(), std::ios::binary);
    out << text;
    out.close();
    if (!out) fail(file, "cannot write", errno);
    pending.commit();
}

// ---- PendingFile

PendingFile::PendingFile(std::string final_name, Existing existing)
    : final_name_(std::move(final_name)), target_(followed_links(final_name_)),
      existing_(existing) {
    for (int number = 0; number < most_names && fs::exists(numbered(number)); ++number)
        remove_left_over(number);
    descriptor_ = ::open(folder_of(target_).c_str(), O_TMPFILE | O_RDWR | O_CLOEXEC, 0666);
    temporary_name_ = "/proc/self/fd/" + std::to_string(descriptor_);
    if (descriptor_ >= 0 && ::access(temporary_name_.c_str(), W_OK) == 0) {
        ::flock(descriptor_, LOCK_EX);
        return;
    }
    if (descriptor_ >= 0) ::close(descriptor_);
    create();
}

std::string PendingFile::numbered(int number) const {
    const std::string name =
        "." + fs::path(target_).filename().string() + "." + std::to_string(number) + ".unfinished";
    return (folder_of(target_) / name).string();
}

/// With a name, on a file system that has no files without.
void PendingFile::create() {
    for (int number = 0; number < most_names; ++number) {
        temporary_name_ = numbered(number);
        descriptor_ = ::open(temporary_name_.c_str(), O_CREAT | O_EXCL | O_RDWR | O_CLOEXEC, 0666);
        if (descriptor_ < 0 && errno != EEXIST)
            fail(final_name_, "cannot create a file in its folder", errno);
        if (descriptor_ < 0) continue;
        ::flock(descriptor_, LOCK_EX);
        // Before that, somebody may have taken it for one whose writer has died.
        has_name_ = has_links(descriptor_);
        if (has_name_) return;
        ::close(descriptor_);
    }
    throw OutputError(final_name_ + ": too many unfinished files (" + numbered(0) +
                      ", ...) in its folder");
}

/// Its writer holds a lock, which ends with it, also on other machines that share the folder.
void PendingFile::remove_left_over(int number) const {
    const std::string name = numbered(number);
    const int descriptor = ::open(name.c_str(), O_RDWR | O_NOFOLLOW | O_CLOEXEC);
    if (descriptor < 0) return;
    if (::flock(descriptor, LOCK_EX | LOCK_NB) == 0 && has_links(descriptor))
        ::unlink(name.c_str());
    ::close(descriptor);
}

PendingFile::~PendingFile() {
    if (has_name_) ::unlink(temporary_name_.c_str());
    if (descriptor_ >= 0) ::close(descriptor_);
}

/// Unless it is taken; 0 or the error's number.
int PendingFile::give_name(const std::string& name) {
    if (has_name_) {
        const int error = rename_if_free(temporary_name_, name);
        if (error == 0) has_name_ = false;
        return error;
    }
    return ::linkat(AT_FDCWD, temporary_name_.c_str(), AT_FDCWD, name.c_str(), AT_SYMLINK_FOLLOW) ==
                   0
               ? 0
               : errno;
}

/// Puts it in the place of the old one; 0 or the error's number.
int PendingFile::replace() {
    int error = has_name_ ? 0 : give_name(target_);
    if (!has_name_ && error != EEXIST) return error;
    for (int number = 0; !has_name_ && number < most_names; ++number) {
        error = give_name(numbered(number));
        if (error != 0 && error != EEXIST) return error;
        if (error != 0) continue;
        has_name_ = true;
        temporary_name_ = numbered(number);
    }
    if (!has_name_) return error;
    if (::rename(temporary_name_.c_str(), target_.c_str()) != 0) return errno;
    has_name_ = false;
    return 0;
}

void PendingFile::commit() {
    // Some file systems have nothing to flush to.
    if (::fsync(descriptor_) != 0 && errno != EINVAL && errno != EROFS)
        fail(final_name_, "cannot write", errno);
    const int error = existing_ == Existing::replace ? replace() : give_name(target_);
    if (error != 0) keep_elsewhere(error);
}

/// Hours of work may be in it.
void PendingFile::keep_elsewhere(int error) {
    const std::string what = error == EEXIST
                                 ? "a file of this name has appeared meanwhile, and "
                                   "there is no --force to replace it"
                                 : std::string("cannot have this name: ") + std::strerror(error);
    const fs::path target(target_);
    for (int number = 1; number < most_names; ++number) {
        const std::string name =
            (folder_of(target_) /
             (target.stem().string() + "." + std::to_string(number) + target.extension().string()))
                .string();
        if (const int taken = give_name(name); taken == 0)
            throw OutputError(final_name_ + ": " + what + "; the new one is " + name);
        else if (taken != EEXIST)
            break;
    }
    throw OutputError(final_name_ + ": " + what);
}

} // namespace parhelion
