// The device of a command line, and what it says of how to render there.
#include "host/commands/render_device_options.h"

#include "host/commands/byte_size.h"
#include "host/commands/compile.h"
#include "host/commands/machine.h"
#include "host/image/output.h"

namespace parhelion {

RenderOptions options_of(const RenderCommand& command) {
    RenderOptions options = command.options;
    if (command.memory) options.memory = parse_byte_size("--memory", *command.memory);
    options.group_memory = cgroup_limits().memory_bytes.value_or(0);
    options.scratch = command.scratch.empty() ? folder_of_output(command.output) : command.scratch;
    return options;
}

RenderDevice& open_device_of(const RenderCommand& command) {
    RenderDevice& device = open_to_the_end(choose_device(command.device));
    device.saves_memory = command.memory.has_value();
    if (device.saves_memory || several_threads())
        device.compile_beside = compile_in_own_process(device.device);
    return device;
}

} // namespace parhelion
