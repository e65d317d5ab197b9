// What one process keeps of files from one scene to the next: the same as reading them again, and
// read again where they have changed.
#include "host/digest.h"
#include "host/file_digests.h"
#include "host/flatten/device_scene.h"
#include "host/scene/meshes/kept_meshes.h"
#include "test_scene_tools.h"
#include "tests/support/image_files.h"

#include <algorithm>

using namespace parhelion;
using namespace parhelion::test;

namespace {

/// Of a file of long ago, each later than the one before.
std::string write_old(const SceneFolder& folder, const std::string& name,
                      const std::string& content) {
    static int written = 0;
    const std::string file = folder.write(name, content);
    std::filesystem::last_write_time(file, std::filesystem::file_time_type::clock::now() -
                                               std::chrono::hours(1) +
                                               std::chrono::milliseconds(++written));
    return file;
}

/// Two meshes of one file, one of them beside it, with a texture each.
std::string text_with(const std::string& first, const std::string& second, double x = 0) {
    const auto shape = [](const std::string& image, double at) {
        return "<shape type=\"obj\"><string name=\"filename\" value=\"mesh.obj\"/><transform "
               "name=\"to_world\"><translate x=\"" +
               std::to_string(at) +
               "\"/></transform><bsdf type=\"diffuse\"><texture type=\"bitmap\" "
               "name=\"reflectance\"><string name=\"filename\" value=\"" +
               image + "\"/></texture></bsdf></shape>\n";
    };
    return scene_text(shape(first, 0) + shape(second, x));
}

constexpr const char* one_triangle = "v 0 0 5\nv 1 0 5\nv 0 1 5\nvt 0 0\nf 1/1 2/1 3/1\n";
constexpr const char* another = "v 0 0 6\nv 1 0 5\nv 0 1 5\nvt 0 0\nf 1/1 2/1 3/1\n";

/// A .pfm of one grey texel.
std::string grey(float value) { return pfm_of(1, 1, {value}, 1); }

Mesh first_mesh(const Scene& scene) { return std::get<Mesh>(scene.shapes.at(0).geometry); }

std::vector<int> texels(const DeviceScene& scene) {
    return {scene.texels.begin(), scene.texels.end()};
}

/// The texels of the scene with what `before` has, which must be those without.
DeviceScene flattened_after(const Scene& scene, DeviceScene& before) {
    DeviceScene flat = flatten_scene(scene, LightChoice::importance, &before);
    CHECK(texels(flat) == texels(flatten_scene(scene)));
    return flat;
}

} // namespace

TEST_CASE("Kept meshes: made once a file, key and content; dropped when a scene has no use") {
    const SceneFolder folder;
    const std::string file = write_old(folder, "a.obj", "1"),
                      other = write_old(folder, "b.obj", "2");
    KeptMeshes kept;
    int made = 0;
    const auto ask = [&](const std::string& name, const std::string& key) {
        const MadeMesh mesh = kept.mesh(name, key, [&] {
            made++;
            MadeMesh m;
            m.notes = {"made " + std::to_string(made)};
            return m;
        });
        return mesh.notes.at(0);
    };
    CHECK(ask(file, "x") == "made 1");
    CHECK(ask(file, "x") == "made 1");
    CHECK(ask(file, "y") == "made 2");
    CHECK(ask(other, "x") == "made 3");
    write_old(folder, "a.obj", "1 and more");
    CHECK(ask(file, "x") == "made 4");
    kept.next_scene();
    CHECK(ask(file, "x") == "made 4");
    kept.next_scene(); // without the others
    CHECK(ask(file, "y") == "made 5");
    CHECK(ask(other, "x") == "made 6");
    // What could not be made is not kept, nor is what was there before.
    write_old(folder, "a.obj", "broken");
    CHECK_THROWS_AS(kept.mesh(file, "x", []() -> MadeMesh { throw InputError("broken"); }),
                    InputError);
    CHECK(ask(file, "x") == "made 7");
}

TEST_CASE("Kept meshes: a key has all that a mesh depends on") {
    const MeshOptions plain;
    MeshOptions moved = plain, faces = plain, flipped = plain;
    moved.to_world[3][0] = 0x1p-40;
    faces.face_normals = true, flipped.flip_normals = true;
    const SourceLocation here{"s.xml", 3}, there{"s.xml", 4};
    std::vector<std::string> keys{
        mesh_key("obj", plain, here),         mesh_key("obj", moved, here),
        mesh_key("obj", faces, here),         mesh_key("obj", flipped, here),
        mesh_key("obj", plain, there),        mesh_key("ply", plain, here),
        mesh_key("serialized 1", plain, here)};
    CHECK(mesh_key("obj", plain, here) == keys[0]);
    std::sort(keys.begin(), keys.end());
    CHECK(std::adjacent_find(keys.begin(), keys.end()) == keys.end());
}

TEST_CASE("Kept meshes: a scene has the same ones, and those of a file that has changed") {
    const SceneFolder folder;
    write_old(folder, "mesh.obj", one_triangle);
    write_old(folder, "a.pfm", grey(0.5F));
    const std::string file = write_old(folder, "scene.xml", text_with("a.pfm", "a.pfm", 3));
    KeptMeshes kept;
    LoadOptions options;
    options.meshes = &kept;
    const Scene without = load_scene(file), once = load_scene(file, options);
    kept.next_scene();
    const Scene twice = load_scene(file, options);
    for (const Scene* scene : {&once, &twice})
        for (std::size_t i = 0; i < 2; i++) {
            const Mesh mesh = std::get<Mesh>(scene->shapes[i].geometry),
                       wanted = std::get<Mesh>(without.shapes[i].geometry);
            CHECK(mesh.positions == wanted.positions);
            CHECK(mesh.normals == wanted.normals);
            CHECK(mesh.uvs == wanted.uvs);
            CHECK(mesh.triangles == wanted.triangles);
        }
    CHECK(once.notes == without.notes);
    CHECK(twice.notes == without.notes);
    write_old(folder, "mesh.obj", another); // as long
    CHECK(first_mesh(load_scene(file, options)).positions ==
          first_mesh(load_scene(file)).positions);
    CHECK(first_mesh(load_scene(file)).positions != first_mesh(without).positions);
}

TEST_CASE("Kept texels: all of them, some, none, and those of files that have changed") {
    const SceneFolder folder;
    write_old(folder, "mesh.obj", one_triangle);
    write_old(folder, "a.pfm", grey(0.5F));
    write_old(folder, "b.pfm", grey(0.25F));
    write_old(folder, "c.pfm", grey(0.125F));
    const auto load = [&](const std::string& first, const std::string& second) {
        return load_scene(write_old(folder, "scene.xml", text_with(first, second)));
    };
    DeviceScene nothing;
    DeviceScene ab = flattened_after(load("a.pfm", "b.pfm"), nothing);
    DeviceScene same = flattened_after(load("a.pfm", "b.pfm"), ab);
    CHECK(ab.texels.empty()); // taken, not copied
    DeviceScene turned = flattened_after(load("b.pfm", "a.pfm"), same);
    CHECK_FALSE(same.texels.empty());
    DeviceScene some = flattened_after(load("c.pfm", "a.pfm"), turned);
    DeviceScene one = flattened_after(load("a.pfm", "a.pfm"), some);
    write_old(folder, "a.pfm", grey(0.75F));
    DeviceScene changed = flattened_after(load("a.pfm", "a.pfm"), one);
    CHECK(texels(changed) != texels(one));
    const Scene none = load_body("<shape type=\"sphere\"/>");
    DeviceScene empty = flattened_after(none, changed);
    CHECK(empty.texels.empty());
    flattened_after(load("a.pfm", "b.pfm"), empty);
}

TEST_CASE("Kept digests: a file's digest, again where it has changed") {
    const SceneFolder folder;
    const std::string file = write_old(folder, "a", "one");
    FileDigests digests;
    CHECK(digests.of(file) == digest_of("one"));
    CHECK(digests.of(file) == digest_of("one"));
    write_old(folder, "a", "two");
    CHECK(digests.of(file) == digest_of("two"));
    std::filesystem::remove(file);
    CHECK_THROWS_AS(digests.of(file), InputError);
    // Written just now, and again at once: the clock may not have moved.
    for (int i = 0; i < 100; i++) {
        const std::string text = std::to_string(100 + i);
        folder.write("a", text);
        REQUIRE(digests.of(file) == digest_of(text));
    }
}
