// The host's probes: intersection, surfaces, leaving them, and the camera.
#define PROBES_HEADER "kernels/stress/probes_surface.h"
#define PROBES_OF_GROUP probes_of_surface
#include "host/numerics/probe_group.h"
