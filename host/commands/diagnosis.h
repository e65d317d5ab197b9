// What `parhelion doctor` has found, and what follows from it.
#pragma once

#include "host/commands/machine.h"
#include "host/commands/tested_device.h"

#include <nlohmann/json.hpp>

#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace parhelion {

/// A folder that a render writes to, and why it cannot, or nothing.
struct TriedFolder {
    std::string name{};
    std::string why_not{};
};

struct Examination {
    Machine machine{};
    std::vector<std::pair<std::string, std::string>> variables{};
    std::vector<TestedDevice> devices{};
    std::optional<int> chosen{};         ///< the device that a render takes by itself
    std::vector<std::string> failures{}; ///< of platforms
    std::string no_device{};             ///< why there is none, or none to take
    TriedFolder cache{}, temporary{}, current{};
    std::size_t cached_programs = 0;
    std::uint64_t cache_bytes = 0, most_cache_bytes = 0;
    std::string bad_cache_size{}; ///< what is wrong with PARHELION_CACHE_SIZE
};

struct Finding {
    bool prevents = false; ///< a render; else it is worth knowing
    std::string what{}, to_do{};
};

std::vector<Finding> findings(const Examination& examination);

/// One page for a person, and one object for a program.
std::string text_of(const Examination& examination);
nlohmann::ordered_json to_json(const Examination& examination);

} // namespace parhelion
