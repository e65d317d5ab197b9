// The report as text and as JSON.
#include "host/catalogue/report.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>

namespace parhelion::stress {
namespace {

using nlohmann::ordered_json;

ordered_json check_json(const RowResult& r, const Check& c) {
    ordered_json json{{"name", c.name},       {"value", c.value},       {"target", c.target},
                      {"holds", c.holds()},   {"at_least", c.at_least}, {"unit", c.unit},
                      {"samples", c.samples}, {"row", r.row.name},      {"chapter", r.row.chapter}};
    if (c.mean >= 0) json["mean"] = c.mean;
    if (!c.worst_at.empty()) json["worst_at"] = c.worst_at;
    if (!c.note.empty()) json["note"] = c.note;
    return json;
}

} // namespace

bool Report::holds() const {
    return std::all_of(rows.begin(), rows.end(), [](const RowResult& r) {
        return std::all_of(r.checks.begin(), r.checks.end(),
                           [](const Check& c) { return c.holds(); });
    });
}

std::size_t Report::check_count() const {
    std::size_t count = 0;
    for (const RowResult& r : rows)
        count += r.checks.size();
    return count;
}

double Report::seconds() const {
    double sum = 0;
    for (const RowResult& r : rows)
        sum += r.seconds;
    return sum;
}

std::string text_line(const Check& c) {
    std::string line =
        fmt::format("{:5}  {:<62}  {:>10.4g} {} {:<9.4g} {}", c.holds() ? "ok" : "FAILS", c.name,
                    c.value, c.at_least ? ">=" : "<=", c.target, c.unit);
    if (c.samples > 0) line += fmt::format("  ({:.3g} samples)", static_cast<double>(c.samples));
    if (!c.holds() && !c.worst_at.empty()) line += "\n       at " + c.worst_at;
    return line;
}

ordered_json report_json(const Report& report) {
    ordered_json checks = ordered_json::array();
    for (const RowResult& r : report.rows)
        for (const Check& c : r.checks)
            checks.push_back(check_json(r, c));
    ordered_json seconds;
    for (const RowResult& r : report.rows)
        seconds[r.row.name] = r.seconds;
    return {{"version", report.version},
            {"effort", report.effort},
            {"seed", report.seed},
            {"device", report.device.name},
            {"driver", report.device.driver_version},
            {"holds", report.holds()},
            {"seconds", report.seconds()},
            {"row_seconds", seconds},
            {"checks", checks}};
}

} // namespace parhelion::stress
