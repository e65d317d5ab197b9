// Probes: the film's sums and spreads.
#include "device/device.h"
#include "device/lanes_memory.h"

#include "stress/probe_words.h"
#include "stress/probes_film.h"

#include "stress/probe_kernel.h"
