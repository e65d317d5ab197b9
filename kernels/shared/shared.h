// All shared maths, in floor order: each file uses only what stands above it. The same text
// compiles as OpenCL C (16, 8 or 1 lanes) and as C++ (float or double); other shared headers
// include nothing.

#include "shared/lane.h"
#include "shared/math.h"
#include "shared/records.h"
#include "shared/two_real.h"

#include "shared/draws.h"
#include "shared/sampler.h"

#include "shared/error_function.h"
#include "shared/faure.h"
#include "shared/film_sum.h"
#include "shared/fresnel.h"
#include "shared/intersect.h"
#include "shared/intersect_edges.h"
#include "shared/intersect_triangle.h"
#include "shared/shading_frame.h"
#include "shared/shading_normal.h"
#include "shared/solid_angle.h"
#include "shared/spawn_ray.h"
#include "shared/tilt.h"
#include "shared/warp.h"

#include "shared/microfacet_ggx.h"
#include "shared/surface.h"

#include "shared/microfacet_beckmann.h"

#include "shared/microfacet.h"

#include "shared/bsdf_types.h"
#include "shared/emitter_types.h"
#include "shared/energy_compensation.h"
#include "shared/light_importance.h"
#include "shared/principled.h"

#include "shared/bsdf_conductor.h"
#include "shared/bsdf_dielectric.h"
#include "shared/bsdf_diffuse.h"
#include "shared/bsdf_null.h"
#include "shared/bsdf_plastic.h"
#include "shared/bsdf_principled.h"
#include "shared/bsdf_principledthin.h"
#include "shared/bsdf_roughconductor.h"
#include "shared/bsdf_roughdielectric.h"
#include "shared/bsdf_roughdiffuse.h"
#include "shared/bsdf_roughplastic.h"
#include "shared/bsdf_thindielectric.h"

#include "shared/emitter_area_cylinder.h"
#include "shared/emitter_area_disk.h"
#include "shared/emitter_area_parallelogram.h"
#include "shared/emitter_area_sphere.h"
#include "shared/emitter_area_tiny_triangle.h"
#include "shared/emitter_area_triangle.h"
#include "shared/emitter_constant.h"
#include "shared/emitter_directional.h"
#include "shared/emitter_envmap.h"
#include "shared/emitter_point.h"
#include "shared/emitter_projector.h"
#include "shared/emitter_spot.h"

#include "shared/bsdf.h"
#include "shared/camera.h"
#include "shared/emitter.h"
#include "shared/roulette.h"
