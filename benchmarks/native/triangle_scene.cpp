// Triangle scenes made by code: rooms, hills, rocks and bunnies.
#include "benchmarks/native/triangle_scene.h"

#include "host/error.h"
#include "host/scene/meshes/mesh_obj.h"
#include "kernels/shared/features.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <random>

namespace parhelion::bench {
namespace {

struct Placement {
    Point position;
    double scale, turn, tilt; ///< tilt about x, then turn about y, radians
};

void add_mesh(TriangleMesh& to, const TriangleMesh& mesh, const Placement& p) {
    auto base = static_cast<std::uint32_t>(to.vertices.size());
    double ct = std::cos(p.turn), st = std::sin(p.turn), cx = std::cos(p.tilt),
           sx = std::sin(p.tilt);
    for (const Point& v : mesh.vertices) {
        double y = v.y * cx - v.z * sx, z = v.y * sx + v.z * cx;
        to.vertices.push_back({float(p.scale * (v.x * ct + z * st) + p.position.x),
                               float(p.scale * y + p.position.y),
                               float(p.scale * (z * ct - v.x * st) + p.position.z)});
    }
    for (const Triangle& t : mesh.triangles)
        to.triangles.push_back({base + t.a, base + t.b, base + t.c});
}

/// Rows x columns quadrilaterals over the unit square, two triangles each, at place(u, v).
template<class Place>
TriangleMesh grid(int rows, int columns, const Place& place) {
    TriangleMesh mesh;
    for (int j = 0; j <= rows; j++)
        for (int i = 0; i <= columns; i++)
            mesh.vertices.push_back(place(double(i) / columns, double(j) / rows));
    for (int j = 0; j < rows; j++) {
        for (int i = 0; i < columns; i++) {
            auto a = static_cast<std::uint32_t>(j * (columns + 1) + i);
            auto below = a + static_cast<std::uint32_t>(columns) + 1;
            mesh.triangles.push_back({a, a + 1, below + 1});
            mesh.triangles.push_back({a, below + 1, below});
        }
    }
    return mesh;
}

/// The inside of a box: 12 triangles.
void add_room(TriangleMesh& to, const Point& low, const Point& high) {
    constexpr int faces[6][4] = {{0, 1, 5, 4}, {2, 3, 7, 6}, {0, 1, 3, 2},
                                 {4, 5, 7, 6}, {0, 2, 6, 4}, {1, 3, 7, 5}};
    TriangleMesh box;
    for (int i = 0; i < 8; i++)
        box.vertices.push_back(
            {i & 1 ? high.x : low.x, i & 2 ? high.y : low.y, i & 4 ? high.z : low.z});
    for (const auto& f : faces) {
        auto at = [&](int k) { return static_cast<std::uint32_t>(f[k]); };
        box.triangles.push_back({at(0), at(1), at(2)});
        box.triangles.push_back({at(0), at(2), at(3)});
    }
    add_mesh(to, box, {{0, 0, 0}, 1, 0, 0});
}

/// Octaves of crossed waves.
double hill_height(double x, double z) {
    double height = 0, amplitude = 0.25, frequency = 0.7;
    for (int octave = 0; octave < 7; octave++) {
        height += amplitude * std::sin(frequency * x + 1.3 * octave) *
                  std::cos(1.1 * frequency * z + 2.1 * octave);
        amplitude *= 0.5;
        frequency *= 2.1;
    }
    return height;
}

TriangleMesh hills(int cells) {
    return grid(cells, cells, [](double u, double v) {
        double x = 16 * u - 8, z = 16 * v - 8;
        return Point{float(x), float(hill_height(x, z)), float(z)};
    });
}

/// A bumpy ball of radius about 0.5.
TriangleMesh rock(int rows, double phase) {
    return grid(rows, 2 * rows, [&](double u, double v) {
        double a = 2 * M_PI * u, b = M_PI * v;
        double x = std::sin(b) * std::cos(a), y = std::cos(b), z = std::sin(b) * std::sin(a);
        double r = 0.4;
        for (int octave = 1; octave <= 16; octave *= 2)
            r += 0.06 / octave * std::sin(3 * octave * x + phase) *
                 std::sin(3 * octave * y + 2 * phase) * std::cos(3 * octave * z - phase);
        return Point{float(r * x), float(r * y), float(r * z)};
    });
}

/// The bunny standing on y = 0, centred, its longest side 1.
TriangleMesh load_bunny() {
    if (!std::filesystem::exists(bunny_file))
        throw InputError(std::string("no ") + bunny_file + ": install Debian's glmark2-data");
    MeshData data = load_obj(bunny_file, true, {});
    glm::dvec3 low = data.positions.at(0), high = low;
    for (const glm::dvec3& p : data.positions)
        low = glm::min(low, p), high = glm::max(high, p);
    glm::dvec3 size = high - low, foot{(low.x + high.x) / 2, low.y, (low.z + high.z) / 2};
    double longest = std::max({size.x, size.y, size.z});
    TriangleMesh mesh;
    for (const glm::dvec3& p : data.positions) {
        glm::dvec3 q = (p - foot) / longest;
        mesh.vertices.push_back({float(q.x), float(q.y), float(q.z)});
    }
    for (const glm::uvec3& t : data.triangles)
        mesh.triangles.push_back({t.x, t.y, t.z});
    return mesh;
}

/// Uniform numbers that are the same on every machine (std's distributions are not).
class Random {
public:
    explicit Random(std::uint32_t seed) : engine_(seed) {}
    double between(double low, double high) { return low + (high - low) * engine_() * 0x1p-32; }

private:
    std::mt19937 engine_;
};

constexpr int rock_count = 24, bunny_count = 20;

/// Fills `mesh` up to `triangles` with hills (two fifths) and rocks (the rest).
void add_hills_and_rocks(TriangleMesh& mesh, std::size_t triangles, Random& random) {
    std::size_t left = triangles > mesh.triangles.size() ? triangles - mesh.triangles.size() : 0;
    int cells = std::max(4, int(std::lround(std::sqrt(0.4 * double(left) / 2))));
    add_mesh(mesh, hills(cells), {{0, 0, 0}, 1, 0, 0});
    int rows = std::max(3, int(std::lround(std::sqrt(0.6 * double(left) / rock_count / 4))));
    for (int k = 0; k < rock_count; k++) {
        Point at{float(random.between(-7, 7)), float(random.between(2.2, 5.7)),
                 float(random.between(-7, 7))};
        double scale = random.between(0.5, 1.6), turn = random.between(0, 2 * M_PI);
        add_mesh(mesh, rock(rows, k), {at, scale, turn, random.between(0, 2 * M_PI)});
    }
}

} // namespace

TriangleScene bunny_room() {
    TriangleScene s{"bunny room",          {},           {0.3f, 0.7f, 1.9f}, {0, 0.2f, 0}, 50,
                    {-0.4f, 2.49f, -0.4f}, {0.8f, 0, 0}, {0, 0, 0.8f}};
    add_room(s.mesh, {-2, -0.5f, -2}, {2, 2.5f, 2});
    add_mesh(s.mesh, load_bunny(), {{0, -0.5f, 0}, 1.6, 0.4, 0});
    return s;
}

TriangleScene landscape(std::size_t triangles) {
    TriangleScene s{"landscape",    {},        {0.5f, 2.6f, 7.6f}, {0, 0.9f, 0}, 65,
                    {-2, 6.9f, -2}, {4, 0, 0}, {0, 0, 4}};
    add_room(s.mesh, {-8, -0.5f, -8}, {8, 7, 8});
    TriangleMesh bunny = load_bunny();
    Random random(7);
    for (int k = 0; k < bunny_count; k++) {
        double x = random.between(-6.5, 6.5), z = random.between(-7, 6);
        Point at{float(x), float(hill_height(x, z) - 0.05), float(z)};
        double scale = random.between(0.8, 2.2);
        add_mesh(s.mesh, bunny, {at, scale, random.between(0, 2 * M_PI), 0});
    }
    add_hills_and_rocks(s.mesh, triangles, random);
    return s;
}

TriangleMesh hills_and_rocks(std::size_t triangles) {
    TriangleMesh mesh;
    Random random(7);
    add_hills_and_rocks(mesh, triangles, random);
    return mesh;
}

std::vector<PrimitiveRecord> primitive_records(const TriangleMesh& mesh) {
    std::vector<PrimitiveRecord> records(mesh.triangles.size());
    for (std::size_t i = 0; i < records.size(); i++) {
        const Triangle& t = mesh.triangles[i];
        const Point &a = mesh.vertices[t.a], &b = mesh.vertices[t.b], &c = mesh.vertices[t.c];
        PrimitiveRecord& p = records[i];
        p.ax = a.x, p.ay = a.y, p.az = a.z;
        p.bx = b.x, p.by = b.y, p.bz = b.z;
        p.cx = c.x, p.cy = c.y, p.cz = c.z;
        p.flags = geometry_triangle;
    }
    return records;
}

IndexedGeometry indexed_geometry(const TriangleMesh& mesh) {
    IndexedGeometry out;
    for (const Point& v : mesh.vertices)
        out.points.insert(out.points.end(), {v.x, v.y, v.z});
    for (const Triangle& t : mesh.triangles)
        out.primitives.push_back(
            {3 * int(t.a), 3 * int(t.b), 3 * int(t.c), 0.f, geometry_triangle, 0, -1});
    return out;
}

} // namespace parhelion::bench
