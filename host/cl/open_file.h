// An open file that closes itself.
#pragma once

#include <unistd.h>

#include <utility>

namespace parhelion {

/// What `open` returned, with all that holds of it: negative is none.
class OpenFile {
public:
    explicit OpenFile(int number) : number_(number) {}
    OpenFile(OpenFile&& other) noexcept : number_(std::exchange(other.number_, -1)) {}
    OpenFile& operator=(OpenFile&& other) noexcept {
        std::swap(number_, other.number_);
        return *this;
    }
    OpenFile(const OpenFile&) = delete;
    ~OpenFile() {
        if (number_ >= 0) close(number_);
    }

    explicit operator bool() const { return number_ >= 0; }
    int number() const { return number_; }
    /// It stays open to the end of the process.
    void keep_open() { number_ = -1; }

private:
    int number_;
};

} // namespace parhelion
