// Compiling the stages' programs, side by side, and what was compiled before not again.
#pragma once

#include "host/waves/render_device.h"
#include "host/waves/stage_report.h"
#include "host/waves/stages.h"

#include <string>
#include <vector>

namespace parhelion {

struct StagePrograms {
    std::vector<Program> programs;    ///< one for each Stage; several are the same
    std::vector<StageReport> reports; ///< likewise
    bool checked = false;
    std::uint64_t beside_peak_bytes = 0; ///< of the process that compiled one of them; 0: none did
    std::vector<std::string> notes{};    ///< for the user: what the cache could not do
};

/// Compiles to the end: no launch compiles anything afterwards. Where two programs are unknown, the
/// last is compiled beside. Throws DeviceError with the compiler's log.
StagePrograms compile_stages(RenderDevice& device, const StageOptions& options);

/// Compiles one program to the end and keeps it for the next run; whether it was there already.
/// Adds to `notes` what the cache could not do. Throws DeviceError.
bool compile_program(RenderDevice& device, ProgramGroup group, const StageOptions& options,
                     std::vector<std::string>& notes);

} // namespace parhelion
