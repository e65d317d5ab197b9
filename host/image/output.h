// Where images are written: refusal before the work starts, and files that appear whole or not at
// all.
#pragma once

#include <string>

namespace parhelion {

enum class ImageFormat { exr, png };

/// What becomes of a file that has the name already when a new one is finished.
enum class Existing { keep, replace };

constexpr Existing existing_files(bool force) { return force ? Existing::replace : Existing::keep; }

/// The format an output name asks for by its extension (any case). Throws InputError for another.
ImageFormat image_format(const std::string& file);

/// Refuses an output that could not be written later: call it before rendering. Throws InputError
/// where the extension is unknown, the folder is missing or not writable, or, if `force` is false,
/// the file exists or is a symbolic link to nothing.
void check_output(const std::string& file, bool force);
/// The same of a file of any extension.
void check_output_file(const std::string& file, bool force);

/// Throws InputError, naming who asks for it, for a folder that is missing or not writable.
void check_folder(const std::string& who, const std::string& folder);

/// The file that a name stands for, there or not: symbolic links followed to their end. Throws
/// InputError for links without one.
std::string followed_links(const std::string& file);

/// The folder that the file is in, or will be, links followed.
std::string folder_of_output(const std::string& file);

/// Writes a whole text file as PendingFile does. Throws OutputError.
void write_text_file(const std::string& file, const std::string& text, Existing existing);

/// A file being written in the folder of its final name, without a name where the system can do
/// that (O_TMPFILE): nothing stays of it when the program ends before `commit`, however that may
/// be. Else it has a name, .NAME.NUMBER.unfinished, that the next one of the same final name
/// removes if its writer has died. Symbolic links stay: the file they lead to is written.
class PendingFile {
public:
    /// Creates it, empty. Throws OutputError where that fails.
    PendingFile(std::string final_name, Existing existing);
    ~PendingFile();
    PendingFile(const PendingFile&) = delete;
    PendingFile& operator=(const PendingFile&) = delete;

    /// What to open for writing.
    const std::string& temporary_name() const { return temporary_name_; }

    /// Flushes to the disk and gives the final name; the writer must have closed the file, having
    /// checked that everything was written. Throws OutputError on failure. Where a file of the
    /// final name has appeared meanwhile and is to be kept, or the name cannot be had, the finished
    /// one gets another name, which the error tells.
    void commit();

private:
    std::string numbered(int number) const;
    void create();
    void remove_left_over(int number) const;
    int give_name(const std::string& name);
    int replace();
    void keep_elsewhere(int error);

    std::string final_name_; ///< as asked for
    std::string target_;     ///< links followed
    Existing existing_;
    int descriptor_ = -1; ///< locked as long as the file is not finished
    std::string temporary_name_;
    bool has_name_ = false; ///< in the folder
};

} // namespace parhelion
