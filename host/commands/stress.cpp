// `parhelion stress`: how accurate this build is on this machine's device.
#include "host/commands/stress.h"

#include "host/clock.h"
#include "host/commands/version.h"
#include "host/error.h"
#include "host/image/distinct_files.h"
#include "host/image/output.h"
#include "host/json_text.h"
#include "host/scene/limits.h"
#include "host/streams.h"
#include "host/stress/catalogue.h"
#include "host/stress/report.h"
#include "host/waves/render_device.h"

#include <fmt/format.h>

#include <filesystem>
#include <memory>

namespace parhelion {
namespace {

struct StressCommand {
    bool quick = false, full = false, list = false, quiet = false, force = false;
    std::string filter, report_folder, json_file, device;
    std::optional<std::uint32_t> seed;
};

std::vector<stress::Row> wanted_rows(const std::string& filter) {
    std::vector<stress::Row> rows;
    for (const stress::Row& row : stress::catalogue())
        if (row.name.find(filter) != std::string::npos || row.chapter == filter)
            rows.push_back(row);
    if (rows.empty())
        throw InputError(
            fmt::format("--filter {}: no row or chapter of that name; --list shows them", filter));
    return rows;
}

void list_rows(const std::vector<stress::Row>& rows) {
    for (const stress::Row& row : rows)
        print(fmt::format("{:<12} {:<34} {}\n", row.chapter, row.name, row.title));
}

stress::RowResult run_row(const stress::Row& row, stress::StressRun& run, Progress& progress) {
    progress.start(row.name);
    auto start = Clock::now();
    stress::RowResult result{row, row.run(run), 0};
    result.seconds = seconds_since(start);
    std::size_t failing = 0;
    for (const stress::Check& check : result.checks) {
        failing += !check.holds();
        print(stress::text_line(check) + '\n');
    }
    progress.finish(failing == 0 ? "all hold"
                                 : fmt::format("{} of {} FAIL", failing, result.checks.size()));
    return result;
}

std::string page_file(const StressCommand& c) {
    return (std::filesystem::path(c.report_folder) / "index.html").string();
}

/// Refuses what could not be written after minutes of work; makes the folder of the page.
void check_outputs(const StressCommand& c) {
    if (!c.json_file.empty()) check_output_file(c.json_file, c.force);
    if (c.report_folder.empty()) return;
    std::error_code error;
    std::filesystem::create_directories(c.report_folder, error);
    if (error) throw InputError(fmt::format("--report {}: {}", c.report_folder, error.message()));
    check_output_file(page_file(c), c.force);
    check_distinct({{"--json", c.json_file}, {"--report", page_file(c)}}, {});
}

int run_stress(const StressCommand& c) {
    if (c.quick && c.full) throw InputError("stress: --quick or --full, not both");
    std::vector<stress::Row> rows = wanted_rows(c.filter);
    if (c.list) {
        list_rows(rows);
        return static_cast<int>(ExitCode::ok);
    }
    check_outputs(c);
    Progress progress = Progress::standard(c.quiet);
    RenderDevice& device = open_to_the_end(choose_device(c.device));
    stress::StressRun run(device, c.full ? stress::Effort::full : stress::Effort::quick,
                          c.seed.value_or(1), progress);
    stress::Report report{c.full ? "full" : "quick", version_text(), run.seed, device.device, {}};
    for (const stress::Row& row : rows)
        report.rows.push_back(run_row(row, run, progress));
    if (!c.json_file.empty())
        write_text_file(c.json_file, json_text(stress::report_json(report)),
                        existing_files(c.force));
    if (!c.report_folder.empty())
        write_text_file(page_file(c), stress::report_page(report), existing_files(c.force));
    print(fmt::format("{} checks in {:.0f} s: {}\n", report.check_count(), report.seconds(),
                      report.holds() ? "all hold" : "NOT all hold"));
    return static_cast<int>(report.holds() ? ExitCode::ok : ExitCode::different);
}

} // namespace

Subcommand stress_subcommand() {
    auto c = std::make_shared<StressCommand>();
    return {
        .name = "stress",
        .summary = "Test the numerics on this machine: every function against a higher precision, "
                   "rays, sums, statistics",
        .examples = "Examples:\n"
                    "  parhelion stress                                # minutes; exit code 1 if a "
                    "check does not hold\n"
                    "  parhelion stress --full --report stress/        # hours: 1e9 inputs a "
                    "function; a page with plots\n"
                    "  parhelion stress --filter fresnel --json fresnel.json\n"
                    "  parhelion stress --list",
        .options = {{"--quick", &c->quick, "Under five minutes (the default)"},
                    {"--full", &c->full, "The release run: hours"},
                    {"--filter", &c->filter, "Only rows whose name holds this, or of this chapter"},
                    {"--list", &c->list, "Show the rows and end"},
                    {"--report", &c->report_folder, "Folder for a page with tables and plots"},
                    {"--json", &c->json_file, "File for all figures"},
                    {"--seed", &c->seed, "Of the random inputs", {.domain = seed_domain}},
                    {"--device", &c->device, "Index, or part of a name (see `parhelion devices`)"},
                    {"--force", &c->force, "Replace existing files"},
                    {"-q,--quiet", &c->quiet, "No progress; errors are told"}},
        .run = [c] { return run_stress(*c); },
    };
}

} // namespace parhelion
