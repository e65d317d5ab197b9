// One sample of an image, vertex by vertex.
#pragma once

#include "host/film/bad_samples.h"
#include "host/scene/scene.h"
#include "host/twin/shade_notes.h"

#include <optional>
#include <string>
#include <vector>

namespace parhelion {

struct TraceVertex {
    int bounce = 0; ///< edges from the camera, less one
    Triple origin{}, direction{}, throughput{};
    float pdf = 0; ///< of the direction, 1/sr; infinite: no other strategy has it
    bool hit = false;
    float t = 0;
    int shape = -1, primitive = -1; ///< primitive: number in its shape
    Triple wo{};                    ///< local space
    int material = -1;              ///< of the side that is looked at; -1: it absorbs
    ShadeNotes notes;
    Triple emission{}; ///< what this vertex has added to the sample
    bool shadow_ray = false, blocked = false;
    Triple light{};    ///< what next event estimation brings if nothing is in the way
    Triple arriving{}; ///< what of that arrives where it is not blocked: less through a mask
    bool goes_on = false;
    Triple throughput_after{};           ///< of the path that goes on
    std::vector<std::string> not_finite; ///< names of the values here that are not
};

struct SampleTrace {
    int x = 0, y = 0, sample = 0;
    bool on_film = true; ///< a wide filter puts some samples beyond the edge: those do not count
    std::vector<TraceVertex> vertices;
    Triple radiance{};
    float alpha = 0, weight = 0;       ///< not finite if the sample is left out
    std::optional<BadSample> left_out; ///< of the image, as the film's accounts have it
    int first_not_finite = -1;         ///< vertex; -1: none
};

/// Traces sample `sample` of pixel (x, y) of the full film, with the kernels compiled as C++: the
/// device's values to the bit.
SampleTrace trace_sample(const Scene& scene, const DeviceScene& flat, int x, int y, int sample);

} // namespace parhelion
