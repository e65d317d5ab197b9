// Probes: every kind of emitter.
#include "device/device.h"
#include "device/lanes_memory.h"

#include "stress/probe_words.h"
#include "stress/probes_emitter.h"

#include "stress/probe_kernel.h"
