// The host's probes: every kind of emitter.
#define PROBES_HEADER "kernels/stress/probes_emitter.h"
#define PROBES_OF_GROUP probes_of_emitter
#include "host/numerics/probe_group.h"
