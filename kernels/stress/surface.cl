// Probes: intersection, surfaces, leaving them, and the camera.
#include "device/device.h"
#include "device/lanes_memory.h"

#include "stress/probe_words.h"
#include "stress/probes_surface.h"

#include "stress/probe_kernel.h"
