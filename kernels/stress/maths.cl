// Probes: vectors, elementary functions, the sampler, warps, frames, Fresnel terms and microfacets.
#include "device/device.h"
#include "device/lanes_memory.h"

#include "stress/probe_words.h"
#include "stress/probes_maths.h"

#include "stress/probe_kernel.h"
