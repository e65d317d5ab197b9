// White furnaces of rough materials with energy compensation: by quadrature, at every roughness and
// angle tested.
#include "host/catalogue/rows.h"
#include "host/scene/mitsuba/number_parameters.h"

#include "host/numerics/white_furnace.h"

namespace parhelion::stress {
namespace {

Check furnace_check(const std::string& name, const FurnaceError& error) {
    return {.name = "white furnace, " + name,
            .value = std::fabs(error.worst),
            .target = 0.003,
            .unit = "relative",
            .worst_at = error.where};
}

/// The least and the largest roughness that a scene file may give a plugin.
std::array<double, 2> ends_of(const char* plugin) {
    const Domain& alpha = mitsuba::number_parameter("bsdf", plugin, "alpha").domain;
    return {alpha.lowest, alpha.highest};
}

} // namespace

Checks row_white_furnace(StressRun& run) {
    Checks checks;
    for (int distribution : {0, 1}) {
        std::string name = distribution ? "Beckmann" : "GGX";
        FurnaceError metal, glass, plastic, anisotropic, ends;
        for (double alpha : furnace_roughnesses) {
            add_furnaces(lossless(material_roughconductor, distribution, alpha, alpha, 1.5), {0.3},
                         metal);
            for (double index : {1.01, 1.1, 1.5, 2.5, 1 / 1.01, 1 / 1.33, 1 / 2.5})
                add_furnaces(lossless(material_roughdielectric, distribution, alpha, alpha, index),
                             {0.3}, glass);
            for (double index : {1.01, 1.1, 1.49, 2.5})
                add_coat_furnaces(distribution, alpha, index, plastic);
        }
        const std::vector<double> azimuths{0, 0.05, 0.3, 0.8, 1.2, M_PI / 2, 2.5};
        for (auto [u, v] :
             {std::pair{0.05, 0.2}, {0.3, 0.1}, {0.1, 1.0}, {0.01, 0.3}, {1.0, 0.002}})
            add_furnaces(lossless(material_roughconductor, distribution, u, v, 1.5), azimuths,
                         anisotropic);
        add_furnaces(lossless(material_roughdielectric, distribution, 0.1, 0.4, 1.5), azimuths,
                     anisotropic);
        for (double alpha : ends_of("roughconductor"))
            add_furnaces(lossless(material_roughconductor, distribution, alpha, alpha, 1.5), {0.3},
                         ends);
        for (double alpha : ends_of("roughdielectric"))
            for (double index : {0.01, 1 / 1.003, 1.003, 1.5, 100.0})
                add_furnaces(lossless(material_roughdielectric, distribution, alpha, alpha, index),
                             {0.3}, ends);
        checks.push_back(furnace_check(name + " metal", metal));
        checks.push_back(furnace_check(name + " glass", glass));
        checks.push_back(furnace_check(name + " plastic", plastic));
        checks.push_back(furnace_check(name + ", anisotropic", anisotropic));
        for (double alpha : ends_of("roughplastic"))
            for (double index : {1.003, 1.5, 100.0})
                add_coat_furnaces(distribution, alpha, index, ends);
        checks.push_back(furnace_check(name + ", ends of what scenes may ask for", ends));
        run.done(0.5 + 0.5 * distribution);
    }
    return checks;
}

} // namespace parhelion::stress
