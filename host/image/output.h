// Where images are written: refusal before the work starts, and files that appear whole or not at
// all.
#pragma once

#include <string>

namespace parhelion {

enum class ImageFormat { exr, png };

/// The format an output name asks for by its extension (any case). Throws InputError for another.
ImageFormat image_format(const std::string& file);

/// Refuses an output that could not be written later: call it before rendering. Throws InputError
/// where the extension is unknown, the folder is missing or not writable, or the file exists and
/// `force` is false.
void check_output(const std::string& file, bool force);
/// The same of a file of any extension.
void check_output_file(const std::string& file, bool force);

/// Writes a whole text file under a temporary name, then renames it. Throws InputError.
void write_text_file(const std::string& file, const std::string& text);

/// A file under a temporary name beside its final one. `commit` gives it its final name in one
/// step; without it the destructor removes it.
class PendingFile {
public:
    /// Creates the temporary file, empty. Throws InputError where that fails.
    explicit PendingFile(std::string final_name);
    ~PendingFile();
    PendingFile(const PendingFile&) = delete;
    PendingFile& operator=(const PendingFile&) = delete;

    const std::string& temporary_name() const { return temporary_name_; }

    /// Flushes to the disk and renames; the writer must have closed the file, having checked that
    /// everything was written. Throws InputError on failure.
    void commit();

private:
    std::string final_name_;
    std::string temporary_name_;
    bool committed_ = false;
};

} // namespace parhelion
