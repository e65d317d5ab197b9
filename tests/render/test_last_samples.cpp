// The last samples of as many as a pixel can have, 2^31 - 1, are samples like the first.
#include "host/film/film_file.h"
#include "host/numerics/image_figures.h"
#include "host/render/session.h"
#include "tests/support/render_scene.h"

#include <catch2/catch.hpp>

#include <limits>

using namespace parhelion;
using namespace parhelion::test;

namespace {

constexpr int most = std::numeric_limits<int>::max();

struct Part {
    Image image;
    FilmState state;
};

/// The last of 65536 parts, 32767 samples of each pixel, of one block of 4 x 4.
Part last_part(RenderCommand command) {
    command.samples = most;
    Scene scene = load(command);
    scene.film.width = scene.film.height = 4;
    scene.film.crop_width = scene.film.crop_height = 4;
    Progress quiet{Progress::Mode::quiet};
    Session session(open_on_device(scene, test_device(), {}, quiet),
                    {65536, 65536, Sharding::samples}, quiet);
    while (!session.finished())
        session.step([] { return false; });
    return {session.image(), session.state()};
}

RenderCommand command_of(const std::string& name, const char* sampler) {
    RenderCommand command;
    command.scene_file = source_file("scenes/closed_form/" + name + "/scene.xml");
    command.sampler = sampler;
    return command;
}

} // namespace

TEST_CASE("Last samples: a furnace is what it is, to the last bit") {
    for (const char* sampler : {"faure", "independent"}) {
        RenderCommand command = command_of("enclosure_half", sampler);
        command.next_event = false;
        const Part part = last_part(command);
        const SampleSet last{{0, 1, most - 32767, most}};
        CHECK(part.state.samples == last);
        CHECK(part.state.counts[statistic_camera_rays] == 16 * 32767);
        for (const Channel& channel : part.image.channels)
            for (float value : channel.values)
                CHECK(value == 2 * (1 - 0x1p-12F));
    }
}

TEST_CASE("Last samples: half of a sky is seen by half of the directions") {
    for (const char* sampler : {"faure", "independent"}) {
        const Part part = last_part(command_of("half_blocked_sky", sampler));
        const std::array<double, 3> mean = mean_rgb(part.image);
        // Of 2^19 samples that spread less than their mean: 5 standard deviations.
        for (int c = 0; c < 3; c++)
            CHECK(mean[c] == Approx(std::array{0.6, 0.75, 0.6}[c]).epsilon(5.0 / 724));
    }
}
