// Probes: every kind of material.
#include "device/device.h"
#include "device/lanes_memory.h"

#include "stress/probe_words.h"
#include "stress/probes_bsdf.h"

#include "stress/probe_kernel.h"
