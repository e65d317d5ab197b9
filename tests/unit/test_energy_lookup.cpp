// What the kernels look up in the tables of energy compensation: a rough metal that loses nothing
// is as bright as the sky of 1 around it, however its grooves lie to the view.
#include "tests/support/first_hits.h"

#include <fmt/format.h>

using namespace parhelion;
using namespace parhelion::test;

namespace {

/// A square that fills the view, seen at 65 degrees; the first axis of its roughness is turned.
Scene groove_scene(double alpha_u, double alpha_v, double turn) {
    return scene_of_text(fmt::format(R"(
<integrator type="path"><integer name="max_depth" value="2"/></integrator>
<sensor type="perspective"><float name="fov" value="1"/>
  <transform name="to_world"><lookat origin="0, 9.0631, 4.2262" target="0, 0, 0" up="0, 0, 1"/></transform>
  <film type="hdrfilm"><integer name="width" value="16"/><integer name="height" value="16"/>
    <rfilter type="box"/></film>
  <sampler type="independent"><integer name="sample_count" value="256"/></sampler></sensor>
<emitter type="constant"><rgb name="radiance" value="1, 1, 1"/></emitter>
<shape type="rectangle"><transform name="to_world"><rotate z="1" angle="{}"/></transform>
  <bsdf type="roughconductor"><string name="material" value="none"/>
    <float name="alpha_u" value="{}"/><float name="alpha_v" value="{}"/></bsdf></shape>)",
                                     turn, alpha_u, alpha_v));
}

} // namespace

TEST_CASE("Energy compensation: a rendered furnace is white from every azimuth", "[energy]") {
    for (auto [u, v] : {std::pair{0.1, 1.0}, {1.0, 0.2}})
        for (double turn : {0.0, 8.0, 20.0, 45.0, 75.0}) {
            Image image = host_image(groove_scene(u, v, turn));
            double mean = 0;
            const auto& values = image.channels.front().values;
            for (float x : values)
                mean += double{x} / double(values.size());
            INFO(u << " by " << v << ", turned by " << turn);
            CHECK(mean == Approx(1).margin(0.003));
        }
}
