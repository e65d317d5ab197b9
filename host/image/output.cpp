// Output checks, temporary names and the rename that publishes a finished file.
#include "host/image/output.h"

#include "host/error.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cerrno>
#include <cstring>
#include <fcntl.h>
#include <filesystem>
#include <fstream>
#include <unistd.h>
#include <utility>

namespace parhelion {

namespace fs = std::filesystem;

namespace {

constexpr std::array<std::pair<const char*, ImageFormat>, 2> formats{
    {{".exr", ImageFormat::exr}, {".png", ImageFormat::png}}};

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

[[noreturn]] void fail(const std::string& file, const std::string& what) {
    throw InputError(file + ": " + what + ": " + std::strerror(errno));
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

void check_output_file(const std::string& file, bool force) {
    const fs::path folder = folder_of(file);
    std::error_code error;
    if (!fs::is_directory(folder, error))
        throw InputError(file + ": the folder " + folder.string() + " does not exist");
    if (::access(folder.c_str(), W_OK | X_OK) != 0)
        throw InputError(file + ": the folder " + folder.string() + " is not writable");
    const fs::file_status status = fs::status(file, error);
    if (!fs::exists(status)) return;
    if (!fs::is_regular_file(status)) throw InputError(file + ": exists and is not a regular file");
    if (!force) throw InputError(file + ": exists; give --force to replace it");
}

void write_text_file(const std::string& file, const std::string& text) {
    PendingFile pending(file);
    std::ofstream out(pending.temporary_name(), std::ios::binary);
    out << text;
    out.close();
    if (!out) throw InputError(file + ": cannot be written");
    pending.commit();
}

PendingFile::PendingFile(std::string final_name) : final_name_(std::move(final_name)) {
    const fs::path path(final_name_);
    const std::string stem =
        "." + path.filename().string() + "." + std::to_string(::getpid()) + ".";
    // O_EXCL makes the name ours even where another process or thread counts the same way.
    for (int attempt = 0; attempt < 1000; ++attempt) {
        temporary_name_ =
            (folder_of(final_name_) / (stem + std::to_string(attempt) + ".tmp")).string();
        const int descriptor =
            ::open(temporary_name_.c_str(), O_CREAT | O_EXCL | O_WRONLY | O_CLOEXEC, 0666);
        if (descriptor >= 0) {
            ::close(descriptor);
            return;
        }
        if (errno != EEXIST) fail(final_name_, "cannot create a file in its folder");
    }
    throw InputError(final_name_ + ": too many unfinished files (." + path.filename().string() +
                     ".*.tmp) in its folder");
}

PendingFile::~PendingFile() {
    if (!committed_) ::unlink(temporary_name_.c_str());
}

void PendingFile::commit() {
    const int descriptor = ::open(temporary_name_.c_str(), O_RDONLY | O_CLOEXEC);
    if (descriptor < 0) fail(final_name_, "cannot write");
    const bool synced = ::fsync(descriptor) == 0 || errno == EINVAL || errno == EROFS;
    const int sync_error = errno;
    ::close(descriptor);
    errno = sync_error;
    if (!synced) fail(final_name_, "cannot write");
    if (::rename(temporary_name_.c_str(), final_name_.c_str()) != 0)
        fail(final_name_, "cannot give the finished file its name");
    committed_ = true;
}

} // namespace parhelion
