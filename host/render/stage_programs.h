// Compiling the stages' programs, side by side, and what was compiled before not again.
#pragma once

#include "host/render/render_device.h"
#include "host/render/report.h"
#include "host/render/stages.h"

#include <vector>

namespace parhelion {

struct StageOptions {
    int lanes = 1;
    bool portable = false;
    std::uint64_t features = 0;
    int work_group_size = 1;
};

struct StagePrograms {
    std::vector<cl::Kernel> kernels;  ///< one for each Stage
    std::vector<StageReport> reports; ///< likewise
    std::vector<std::string> keys;    ///< of their programs, one for each ProgramGroup
};

/// Compiles to the end: no launch compiles anything afterwards. Throws DeviceError with the
/// compiler's log.
StagePrograms compile_stages(RenderDevice& device, const StageOptions& options);

/// Keeps freshly compiled programs for the next run, where the driver does not by itself.
void store_programs(const RenderDevice& device, const StagePrograms& stages);

} // namespace parhelion
