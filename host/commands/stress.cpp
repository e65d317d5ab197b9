// `parhelion stress`: how accurate this build is on this machine's device. What it asks is a
// program of its own (host/catalogue).
#include "host/commands/stress.h"

#include "host/commands/render_domains.h"
#include "host/scene/limits.h"

#include <memory>
#include <utility>

namespace parhelion {

Subcommand stress_subcommand(std::function<int(const StressCommand&)> run) {
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
                    {"--brief", &c->brief, "Seconds a row: what the tests of a checkout run"},
                    {"--filter", &c->filter,
                     "Only the row of this name, or those whose name holds it, or of this chapter"},
                    {"--list", &c->list,
                     "Show the rows and end; with --brief: what tests ask, a line each"},
                    {"--lanes",
                     &c->lanes,
                     "Paths a work-item handles at once: 16, 8 or 1; 0 for what suits the device",
                     {.domain = lanes_domain}},
                    {"--portable", &c->portable, "Kernels without x86 intrinsics"},
                    {"--report",
                     &c->report_folder,
                     "Folder for a page with tables and plots",
                     {.kind = ValueKind::folder}},
                    {"--json", &c->json_file, "File for all figures", {.kind = ValueKind::file}},
                    {"--seed", &c->seed, "Of the random inputs", {.domain = seed_domain}},
                    {"--device", &c->device, "Index, or part of a name (see `parhelion devices`)"},
                    {"--force", &c->force, "Replace existing files"},
                    {"-q,--quiet", &c->quiet, "No progress; errors are told"}},
        .run = [c, run = std::move(run)] { return run(*c); },
    };
}

} // namespace parhelion
