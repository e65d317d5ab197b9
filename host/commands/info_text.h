// What `parhelion info` prints for people: a title and lines with labels.
#pragma once

#include "host/safe_text.h"

#include <fmt/format.h>
#include <nlohmann/json_fwd.hpp>

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

struct Film;

/// Width and height, and what of it is sampled. The crop is resolved.
nlohmann::json film_size_json(const Film& film);

/// "512 x 512 pixels, of which 8 x 8 at 2,1, 64 spp".
std::string film_size_text(const nlohmann::json& size, int samples_per_pixel);

} // namespace parhelion
