// Bounds of what the kernels touch on the host.
#include "host/twin/work_item.h"

#include <fmt/format.h>

#include <stdexcept>

namespace parhelion {

const BufferRange& WorkItem::buffer_with(std::uintptr_t base, std::uintptr_t at,
                                         std::size_t bytes) const {
    const char* name = "no buffer";
    for (const BufferRange& b : buffers) {
        if (!b.holds(base, 0)) continue;
        if (b.holds(at, bytes)) return b;
        name = b.name;
    }
    throw std::logic_error(fmt::format("a kernel reads or writes {} bytes outside of its buffers, "
                                       "from {} on",
                                       bytes, name));
}

} // namespace parhelion
