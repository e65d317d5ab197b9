// Renders that are stopped, kept, gone on with, shared out and added up give the bits of one render
// in one go, on whatever device and however the work of each is split.
#include "host/film/film_parts.h"
#include "host/numerics/every_kind_scene.h"
#include "host/numerics/image_figures.h"
#include "host/numerics/measure.h"
#include "host/render/session.h"
#include "tests/support/host_render.h"
#include "tests/support/render_scene.h"

#include <catch2/catch.hpp>
#include <fmt/format.h>

#include <deque>
#include <filesystem>

#include <unistd.h>

using namespace parhelion;
using namespace parhelion::test;
using namespace parhelion::numerics;

namespace {

/// In the temporary folder, gone at the end.
struct Folder {
    std::filesystem::path path =
        std::filesystem::temp_directory_path() / fmt::format("parhelion-session-{}", getpid());
    Folder() { std::filesystem::create_directories(path); }
    ~Folder() { std::filesystem::remove_all(path); }
    Folder(const Folder&) = delete;
    Folder& operator=(const Folder&) = delete;

    std::string file(const std::string& name) const { return path / name; }
};

Scene scene_of(FilterKind filter, int samples) {
    Scene scene = every_kind_scene();
    scene.film.filter.kind = filter;
    scene.sampler.samples_per_pixel = samples;
    return scene;
}

/// Of the film in memory.
enum class Bands { at_once, in_turn };

RenderOptions split_by(int pool_paths, int lanes, std::size_t film_bytes = 0,
                       Bands bands = Bands::at_once) {
    RenderOptions options;
    options.split.pool_paths = pool_paths;
    options.split.film_bytes = film_bytes;
    options.split.bands_in_turn = bands == Bands::in_turn;
    options.scratch = std::filesystem::temp_directory_path();
    options.lanes = lanes;
    return options;
}

struct Opened {
    Progress quiet{Progress::Mode::quiet};
    Session session;

    Opened(const Scene& scene, const RenderOptions& options, const Shard& shard = {})
        : session(open_on_device(scene, test_device(), options, quiet), shard, quiet) {}
};

FilmHeader header_of(const Scene& scene, Session& session) {
    FilmHeader header;
    header.key = {{"the scene", "of a test"}};
    header.content = session.content();
    header.blocks = session.blocks();
    header.samples_per_pixel = scene.sampler.samples_per_pixel;
    header.part = session.all();
    header.state = session.state();
    return header;
}

void finish(Session& session) {
    while (!session.finished())
        session.step([] { return false; });
}

std::uint64_t differing(const Image& a, const Image& b) { return differing_values(a, b).differing; }

/// The film of a part, in a file.
void render_part(const Scene& scene, const RenderOptions& options, const Shard& shard,
                 const std::string& file) {
    Opened part(scene, options, shard);
    finish(part.session);
    write_film(file, header_of(scene, part.session), *part.session.film(), Existing::replace);
}

Image added_up(const std::deque<FilmFile>& parts) {
    check_parts(parts);
    std::vector<const FilmSums*> films;
    films.reserve(parts.size());
    for (const FilmFile& part : parts)
        films.push_back(&part);
    const FilmHeader header = added_header(parts);
    CHECK(missing_text(parts, header).empty());
    return film_image(AddedFilms(films), header.content);
}

} // namespace

TEST_CASE("A render that is stopped after every few waves and goes on from files is the same bits",
          "[render]") {
    const Folder folder;
    for (const FilterKind filter : {FilterKind::box, FilterKind::mitchell}) {
        const Scene scene = scene_of(filter, 50);
        const RenderResult whole = render_quietly(scene);
        Random random(5);
        Image image;
        int sessions = 0;
        for (bool finished = false; !finished; sessions++) {
            // No two of them alike.
            const RenderOptions options =
                split_by(3000 + 1500 * (sessions % 5), sessions % 2 == 0 ? 16 : 8,
                         sessions % 3 == 0 ? 100'000 : 0,
                         sessions % 2 == 0 ? Bands::in_turn : Bands::at_once);
            Opened opened(scene, options);
            Session& session = opened.session;
            const std::string file = folder.file("kept.film");
            if (sessions > 0) {
                const FilmFile kept(file);
                session.take_up(kept, kept.header().state);
            }
            int waves = 2 + static_cast<int>(random.bits() % 9);
            while (!session.finished() && waves > 0) {
                session.step([&] { return --waves <= 0; });
                if (session.in_whole_groups())
                    write_film(file, header_of(scene, session), *session.film(), Existing::replace);
            }
            finished = session.finished();
            image = session.image();
            if (!finished) continue;
            const RenderReport report = session.report();
            CHECK(report.paths == whole.report.paths);
            CHECK(report.bounce_rays == whole.report.bounce_rays);
            CHECK(report.shadow_rays == whole.report.shadow_rays);
        }
        CHECK(sessions > 4);
        CHECK(differing(whole.image, image) == 0);
    }
}

TEST_CASE("A render goes on to more samples than it was to have", "[render]") {
    const Folder folder;
    const Scene few = scene_of(FilterKind::gaussian, 24), many = scene_of(FilterKind::gaussian, 70);
    Opened first(few, {});
    first.session.step([] { return false; }); // all whole groups
    CHECK(first.session.groups_finished());
    CHECK_FALSE(first.session.finished());
    write_film(folder.file("few.film"), header_of(few, first.session), *first.session.film(),
               Existing::keep);
    finish(first.session);
    CHECK(differing(render_quietly(few).image, first.session.image()) == 0);
    CHECK_FALSE(first.session.in_whole_groups());
    const FilmState all_of_few = first.session.state();

    Opened second(many, {});
    const FilmFile film(folder.file("few.film"));
    CHECK(sample_count(film.header().state.samples) == 16LL * film.header().blocks);
    second.session.take_up(film, film.header().state);
    finish(second.session);
    CHECK(differing(render_quietly(many).image, second.session.image()) == 0);

    // Not from a part of a group, and not to fewer.
    CHECK_THROWS_WITH(check_goes_on(all_of_few.samples, 70),
                      Catch::StartsWith("ends within a group"));
    CHECK_NOTHROW(check_goes_on(all_of_few.samples, 24));
    CHECK_THROWS_WITH(check_goes_on(all_of_few.samples, 16), Catch::StartsWith("has 24 samples"));
}

TEST_CASE("Parts of a render add up to it, however each was made", "[render]") {
    const Folder folder;
    for (const FilterKind filter : {FilterKind::box, FilterKind::lanczos}) {
        const Scene scene = scene_of(filter, 100);
        const Image whole = render_quietly(scene).image;
        for (const Sharding by : {Sharding::blocks, Sharding::samples})
            for (const int count : {2, 3, 7, 16}) {
                CAPTURE(by, count);
                std::deque<FilmFile> parts;
                for (int number = count; number > 0; number--) {
                    const std::string file = folder.file(fmt::format("{}.film", number));
                    render_part(scene,
                                split_by(2000 + 900 * number, number % 3 == 0 ? 8 : 16,
                                         number % 4 == 1 ? 150'000 : 0,
                                         number % 8 == 1 ? Bands::in_turn : Bands::at_once),
                                {number, count, by}, file);
                    parts.emplace_back(file);
                }
                CHECK(differing(whole, added_up(parts)) == 0);
            }
    }
}

TEST_CASE("A part made by the host's kernels fits those of the device", "[render]") {
    const Folder folder;
    Scene scene = scene_of(FilterKind::tent, 20);
    const Image whole = render_quietly(scene).image;
    Progress quiet(Progress::Mode::quiet);
    Session host(open_on_host(scene, {}, Precision::single_precision, quiet), {2, 2}, quiet);
    finish(host);
    write_film(folder.file("2.film"), header_of(scene, host), *host.film(), Existing::keep);
    render_part(scene, {}, {1, 2}, folder.file("1.film"));
    std::deque<FilmFile> parts;
    parts.emplace_back(folder.file("1.film")), parts.emplace_back(folder.file("2.film"));
    CHECK(differing(whole, added_up(parts)) == 0);
}

TEST_CASE("A film in bands is the same bits as in one", "[render]") {
    for (const FilterKind filter : {FilterKind::box, FilterKind::lanczos}) {
        const Scene scene = scene_of(filter, 20);
        const Image whole = render_quietly(scene).image;
        for (const std::size_t bytes : {1, 60'000, 400'000})
            CHECK(differing(whole, render_quietly(scene, split_by(5000, 16, bytes)).image) == 0);
    }
}

TEST_CASE("A film of which one band at a time is in memory is the same bits, with all its layers",
          "[render]") {
    for (const FilterKind filter : {FilterKind::box, FilterKind::lanczos})
        for (const int samples : {5, 20}) { // no whole groups, and whole ones and the rest of one
            Scene scene = scene_of(filter, samples);
            scene.integrator.aovs = {{"albedo", "albedo", {}}, {"variance", "variance", {}}};
            scene.integrator.cryptomatte.objects = true;
            scene.film.crop_x += 3, scene.film.crop_y += 5;
            scene.film.crop_width -= 6, scene.film.crop_height -= 9;
            const Image whole = render_quietly(scene).image;
            for (const std::size_t bytes : {1, 400'000, 1 << 30}) {
                const RenderResult result =
                    render_quietly(scene, split_by(5000, 16, bytes, Bands::in_turn));
                CHECK(differing(whole, result.image) == 0);
                CHECK((result.report.film_scratch_bytes > 0) == (bytes < 1 << 30));
            }
        }
}
