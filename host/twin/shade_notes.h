// What the functions that the shade kernel calls at one vertex of a path have answered.
#pragma once

#include "host/twin/wave_memory.h"

#include <array>
#include <optional>
#include <vector>

namespace parhelion {

using Triple = std::array<float, 3>;

/// Absent: the kernel has not asked. What it asks for a lane that is masked out counts too.
struct ShadeNotes {
    struct Surface {
        Triple position, ng, ns;
        std::array<Triple, 3> frame; ///< s, t, n of local space
    };
    struct Emission {
        Triple radiance;
        float pdf; ///< with which next event estimation would have sampled the direction, 1/sr
    };
    struct Pick {
        int row; ///< of the light table
        float pmf;
    };
    struct LightSample {
        Triple wi, weight; ///< weight: radiance / pdf
        float inverse_pdf; ///< sr; 0: a delta light
        Triple target;
        bool distant;
    };
    struct Evaluated {
        Triple f;  ///< with the cosine
        float pdf; ///< 1/sr
    };
    struct Scattered {
        Triple wi, weight; ///< wi in local space
        float pdf, eta;
    };
    struct Survival {
        bool alive;
        float scale; ///< 1 / probability
    };
    struct Draw {
        const char* decision; ///< of BOUNCE_DRAWS
        std::array<unsigned, 4> numbers;
    };

    std::optional<Surface> surface;
    std::optional<int> material; ///< of the side that is looked at; -1: it absorbs
    std::optional<Emission> emission;
    std::optional<float> emission_weight;
    std::optional<Triple> energy_gain; ///< scales all that the surface sends on
    std::optional<Pick> pick;
    std::optional<LightSample> light;
    std::optional<Evaluated> towards_light;
    std::optional<float> light_weight;
    std::optional<float> light_share; ///< what shading that keeps to the geometry lets count
    std::optional<Scattered> scattered;
    std::optional<float> scattered_share;
    std::optional<Survival> roulette;
    std::vector<Draw> draws;
};

/// Runs the shade kernel's work-item 0 and listens to it.
ShadeNotes shade_noted(const HostLaunch<float>& launch, int depth);

} // namespace parhelion
