// The list of all subcommands.
#include "host/commands/subcommands.h"

#include "host/commands/compare.h"
#include "host/commands/compile.h"
#include "host/commands/devices.h"
#include "host/commands/info.h"
#include "host/commands/parameters.h"
#include "host/commands/render.h"
#include "host/commands/run_program.h"
#include "host/commands/stress.h"

namespace parhelion {

std::vector<Subcommand> all_subcommands() {
    const auto run_by_other = [](const StressCommand&) -> int { throw RunByOther{stress_program}; };
    return {render_subcommand(),    compare_subcommand(), info_subcommand(),
            compile_subcommand(),   devices_subcommand(), stress_subcommand(run_by_other),
            parameters_subcommand()};
}

} // namespace parhelion
