// What a queue has under way ends before the memory that it works in.
#pragma once

#include "host/cl/opencl.h"

namespace parhelion {

/// Waits at the end of a scope or of an object, also of one that an error ends: whatever the driver
/// then says, there is nothing more to be done about it.
class QueueEnd {
public:
    explicit QueueEnd(const cl::CommandQueue& queue) : queue_(queue) {}
    QueueEnd(QueueEnd&&) = default;
    QueueEnd& operator=(QueueEnd&&) = default;
    QueueEnd(const QueueEnd&) = delete;
    QueueEnd& operator=(const QueueEnd&) = delete;
    ~QueueEnd() {
        if (queue_()) clFinish(queue_());
    }

private:
    cl::CommandQueue queue_;
};

} // namespace parhelion
