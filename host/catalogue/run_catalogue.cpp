// `parhelion stress` at work: rows of the catalogue, one after the other, and their report.
#include "host/catalogue/run_catalogue.h"

#include "host/catalogue/catalogue.h"
#include "host/catalogue/report.h"
#include "host/clock.h"
#include "host/commands/version.h"
#include "host/error.h"
#include "host/image/distinct_files.h"
#include "host/image/output.h"
#include "host/json_text.h"
#include "host/streams.h"
#include "host/waves/render_device.h"

#include <fmt/format.h>

#include <filesystem>

namespace parhelion::stress {
namespace {

std::vector<Row> wanted_rows(const std::string& filter) {
    std::vector<Row> rows, all = catalogue();
    for (const Row& row : all)
        if (row.name == filter) return {row};
    for (const Row& row : all)
        if (row.name.find(filter) != std::string::npos || row.chapter == filter)
            rows.push_back(row);
    if (rows.empty())
        throw InputError(
            fmt::format("--filter {}: no row or chapter of that name; --list shows them", filter));
    return rows;
}

void list_rows(const std::vector<Row>& rows) {
    for (const Row& row : rows)
        print(fmt::format("{:<12} {:<34} {}\n", row.chapter, row.name, row.title));
}

/// A name, and the options that tell the way to compile kernels: what tests/CMakeLists.txt reads.
void list_tests(const std::vector<Row>& rows) {
    for (const Row& row : rows)
        if (row.ways == Ways::one)
            print(row.name + '\n');
        else
            for (const KernelWay& way : kernel_ways)
                print(fmt::format("{} --lanes {}{}\n", row.name, way.lanes,
                                  way.portable ? " --portable" : ""));
}

Effort effort_of(const StressCommand& c) {
    if (c.brief + c.quick + c.full > 1)
        throw InputError("stress: one of --brief, --quick and --full, not several");
    return c.brief ? Effort::brief : c.full ? Effort::full : Effort::quick;
}

RowResult run_row(const Row& row, StressRun& run, Progress& progress) {
    progress.start(row.name);
    auto start = Clock::now();
    RowResult result{row, row.run(run), 0};
    result.seconds = seconds_since(start);
    std::size_t failing = 0;
    for (const Check& check : result.checks) {
        failing += !check.holds();
        print(text_line(check) + '\n');
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

} // namespace

int run_catalogue(const StressCommand& c) {
    const Effort effort = effort_of(c);
    std::vector<Row> rows = wanted_rows(c.filter);
    if (c.list) {
        if (!c.json_file.empty() || !c.report_folder.empty())
            throw InputError("--list: prints names and runs nothing (accepted without --json and "
                             "--report)");
        c.brief ? list_tests(rows) : list_rows(rows);
        return static_cast<int>(ExitCode::ok);
    }
    check_outputs(c);
    Progress progress = Progress::standard(c.quiet);
    RenderDevice& device = open_to_the_end(choose_device(c.device));
    const KernelWay kernels{device.device.lanes(c.lanes), c.portable};
    StressRun run(device, kernels, effort, c.seed.value_or(1), progress);
    const char* name = effort == Effort::brief ? "brief" : c.full ? "full" : "quick";
    Report report{name, version_text(), run.seed, device.device, {}};
    for (const Row& row : rows)
        report.rows.push_back(run_row(row, run, progress));
    if (!c.json_file.empty())
        write_text_file(c.json_file, json_text(report_json(report)), existing_files(c.force));
    if (!c.report_folder.empty())
        write_text_file(page_file(c), report_page(report), existing_files(c.force));
    print(fmt::format("{} checks in {:.0f} s: {}\n", report.check_count(), report.seconds(),
                      report.holds() ? "all hold" : "NOT all hold"));
    return static_cast<int>(report.holds() ? ExitCode::ok : ExitCode::different);
}

} // namespace parhelion::stress
