// The stress test's report: text, JSON, a page.
#pragma once

#include "host/catalogue/stress_run.h"
#include "host/cl/device.h"

#include <nlohmann/json_fwd.hpp>

#include <string>
#include <vector>

namespace parhelion::stress {

/// A row and what it found.
struct RowResult {
    Row row;
    Checks checks;
    double seconds = 0;
};

struct Report {
    std::string effort, version;
    std::uint64_t seed = 0;
    Device device;
    std::vector<RowResult> rows;

    bool holds() const;
    std::size_t check_count() const;
    double seconds() const;
};

/// "ok" or "FAILS", the value beside its target, how many samples.
std::string text_line(const Check& check);

/// {version, effort, seed, device, holds, seconds, checks: [{name, value, target, holds, ...}]}
nlohmann::ordered_json report_json(const Report& report);

/// One HTML page with everything in it.
std::string report_page(const Report& report);

} // namespace parhelion::stress
