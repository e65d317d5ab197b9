// The host's probes: the film's sums and spreads.
#define PROBES_HEADER "kernels/stress/probes_film.h"
#define PROBES_OF_GROUP probes_of_film
#include "host/numerics/probe_group.h"
