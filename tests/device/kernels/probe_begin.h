// What the probe kernel stands on: the device's maths and memory.
#include "device/device.h"
#include "device/lanes_memory.h"
