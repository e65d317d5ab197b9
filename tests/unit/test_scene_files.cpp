// Files that no one here made: whole scenes that must load, and broken input that must be refused.
#include "test_scene_tools.h"

#include <sstream>
#include <vector>

using namespace parhelion;
using namespace parhelion::test;
using Catch::Matchers::Contains;

namespace {

namespace fs = std::filesystem;

/// Files below `folder` with this extension, in a fixed order.
std::vector<fs::path> files_below(const fs::path& folder, const std::string& extension) {
    std::vector<fs::path> result;
    if (fs::is_directory(folder))
        for (const auto& entry : fs::recursive_directory_iterator(folder))
            if (entry.is_regular_file() && entry.path().extension() == extension)
                result.push_back(entry.path());
    std::sort(result.begin(), result.end());
    return result;
}

/// Lines that start with a file name; or none, where the file is good after all.
void check_message(const std::string& message) {
    std::istringstream lines(message);
    for (std::string line; std::getline(lines, line);)
        CHECK(line.find(": ") != std::string::npos);
}

} // namespace

TEST_CASE("scene files: the shared scenes of this issue load unchanged") {
    const std::string data = shared_data();
    if (data.empty()) return;
    const Scene box = load_scene(data + "/scenes-mitsuba/cornell-box/scene_path.xml");
    CHECK(box.shapes.size() == 8);
    CHECK(box.materials.size() == 8);
    CHECK(box.integrator.max_depth == 30);
    CHECK(box.sampler.samples_per_pixel == 64);
    CHECK(box.film.width == 1024);
    CHECK(box.film.filter.kind == FilterKind::tent);
    CHECK(box.camera.fov_degrees == 19.5);
    CHECK(box.shapes.back().radiance == Rgb(17, 12, 4));
    const Scene measured = load_scene(data + "/scenes-mitsuba/cbox-m2/scene.xml");
    CHECK(measured.shapes.size() == 8);
    CHECK(measured.camera.fov_axis == FovAxis::smaller);
    CHECK(measured.camera.near_clip == 10.0);
    // Mitsuba 3.9.1 for the same spectrum.
    CHECK(measured.shapes[0].radiance->x == Approx(20.71083641052246).epsilon(1e-5));
}

TEST_CASE("scene files: what the other shared scenes need is named") {
    const std::string data = shared_data();
    if (data.empty()) return;
    std::size_t refused = 0;
    for (const fs::path& file : files_below(data + "/scenes-mitsuba", ".xml")) {
        const std::string message = refusal_of(file.string());
        INFO(file);
        if (message.empty()) continue;
        ++refused;
        CHECK_THAT(message, Contains(".xml:") && Contains("not supported"));
    }
    CHECK(refused > 0);
}

TEST_CASE("scene files: verdicts on broken XML") {
    const std::string data = shared_data();
    if (data.empty()) return;
    const fs::path folder = data + "/bad-input/xml/mitsuba3-parser";
    std::ifstream table(folder / "EXPECTED.tsv");
    std::string line;
    std::getline(table, line);
    std::size_t errors = 0;
    while (std::getline(table, line)) {
        std::istringstream fields(line);
        std::string file, verdict;
        std::getline(fields, file, '\t');
        std::getline(fields, verdict, '\t');
        const std::string message = refusal_of((folder / file).string());
        INFO(file << " -> " << message);
        check_message(message);
        if (verdict != "error") continue;
        ++errors;
        CHECK_THAT(message, Contains(file));
    }
    CHECK(errors > 10);
}

TEST_CASE("scene files: broken meshes load or are refused with one line") {
    const std::string data = shared_data();
    if (data.empty()) return;
    std::size_t seen = 0, refused = 0;
    for (const std::string type : {"obj", "ply"})
        for (const fs::path& file : files_below(data + "/bad-input", "." + type)) {
            const SceneFolder folder;
            fs::copy_file(file, folder.path() / "mesh");
            const std::string message =
                refusal_of(folder.write("scene.xml", scene_text("<shape type=\"" + type +
                                                                "\"><string name=\"filename\" "
                                                                "value=\"mesh\"/></shape>")));
            INFO(file << " -> " << message);
            ++seen;
            refused += !message.empty();
            check_message(message);
        }
    CHECK(seen > 50);
    CHECK(refused > 10);
}

TEST_CASE("scene files: any broken file as any kind of mesh is no crash") {
    const std::string data = shared_data();
    if (data.empty()) return;
    std::vector<fs::path> files = files_below(data + "/bad-input", ".exr");
    for (const char* const extension : {".gltf", ".glb", ".bin", "", ".xml"})
        for (const fs::path& file : files_below(data + "/bad-input", extension))
            if (fs::file_size(file) < 100000 && files.size() < 400) files.push_back(file);
    const SceneFolder folder;
    for (const fs::path& file : files) {
        fs::copy_file(file, folder.path() / "mesh", fs::copy_options::overwrite_existing);
        fs::permissions(folder.path() / "mesh", fs::perms::owner_all);
        INFO(file);
        for (const std::string type : {"obj", "ply", "serialized"})
            check_message(refusal_of(
                folder.write("scene.xml", scene_text("<shape type=\"" + type +
                                                     "\"><string name=\"filename\" value=\"mesh\"/>"
                                                     "</shape>"))));
        check_message(
            refusal_of(folder.write("scene.xml", scene_text("<include filename=\"mesh\"/>"))));
    }
}

TEST_CASE("scene files: a shared serialized mesh") {
    const std::string data = shared_data();
    if (data.empty()) return;
    const SceneFolder folder;
    fs::copy_file(data + "/mitsuba-tests/common/meshes/matpreview.serialized",
                  folder.path() / "m.serialized");
    const Scene scene = load_scene(folder.write(
        "scene.xml", scene_text("<shape type=\"serialized\"><string name=\"filename\" "
                                "value=\"m.serialized\"/><integer name=\"shape_index\" "
                                "value=\"1\"/></shape>")));
    const auto& mesh = std::get<Mesh>(scene.shapes[0].geometry);
    CHECK(mesh.triangles.size() == 11808 / 3); // Mitsuba 3.9.1, as the next two lines
    CHECK(mesh.positions[0].x == Approx(0.667028546333313));
    CHECK(mesh.normals[0].z == Approx(0.9970538020133972));
}
