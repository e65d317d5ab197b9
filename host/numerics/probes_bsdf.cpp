// The host's probes: every kind of material.
#define PROBES_HEADER "kernels/stress/probes_bsdf.h"
#define PROBES_OF_GROUP probes_of_bsdf
#include "host/numerics/probe_group.h"
