// The host's probes: vectors, elementary functions, the sampler, warps, frames, Fresnel terms and
// microfacets.
#define PROBES_HEADER "kernels/stress/probes_maths.h"
#define PROBES_OF_GROUP probes_of_maths
#include "host/numerics/probe_group.h"
