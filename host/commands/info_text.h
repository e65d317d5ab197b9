// What `parhelion info` prints for people: a title and lines with labels.
#pragma once

#include "host/safe_text.h"

#include <fmt/format.h>

#include <string>

namespace parhelion {

class InfoText {
public:
    /// An empty title: lines alone.
    explicit InfoText(const std::string& title = "")
        : text_(title.empty() ? "" : as_one_line(title) + '\n') {}

    void add(const std::string& label, const std::string& line) {
        text_ += fmt::format("  {:<10} {}\n", label, as_one_line(line));
    }
    const std::string& text() const { return text_; }

private:
    std::string text_;
};

} // namespace parhelion
