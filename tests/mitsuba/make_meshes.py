"""Writes the small meshes of the comparison scenes (OBJ and PLY; deterministic, no input)."""

import math
import pathlib
import struct

FOLDER = pathlib.Path(__file__).parent / "scenes" / "meshes"


def grid(columns, rows, surface):
    """Rows x columns quads over (u, v) in [0, 1]^2, as points, uvs and quads; seams stay open."""
    points, uvs, quads = [], [], []
    for row in range(rows + 1):
        for column in range(columns + 1):
            u, v = column / columns, row / rows
            points.append(surface(u, v))
            uvs.append((u, v))
    for row in range(rows):
        for column in range(columns):
            a = row * (columns + 1) + column
            quads.append((a, a + 1, a + columns + 2, a + columns + 1))
    return points, uvs, quads


def normals_of(surface, uvs):
    """Unit normals by central differences of the surface: along dp/du x dp/dv."""
    h = 1e-4
    result = []
    for u, v in uvs:
        du = [b - a for a, b in zip(surface(u - h, v), surface(u + h, v))]
        dv = [b - a for a, b in zip(surface(u, v - h), surface(u, v + h))]
        n = (
            du[1] * dv[2] - du[2] * dv[1],
            du[2] * dv[0] - du[0] * dv[2],
            du[0] * dv[1] - du[1] * dv[0],
        )
        length = math.sqrt(sum(x * x for x in n))
        result.append(tuple(x / length for x in n))
    return result


def torus(u, v):
    a, b = 2 * math.pi * u, 2 * math.pi * v
    ring = 0.7 + 0.3 * math.cos(b)
    return (ring * math.cos(a), ring * math.sin(a), 0.3 * math.sin(b))


def wave(u, v):
    x, y = 2 * u - 1, 2 * v - 1
    return (x, y, 0.18 * math.sin(5 * x) * math.cos(4 * y))


def text(values):
    return " ".join(f"{value:.6g}" for value in values)


def write_obj(name, points, faces, uvs=None, normals=None):
    lines = ["v " + text(p) for p in points]
    lines += ["vt " + text(t) for t in uvs or []]
    lines += ["vn " + text(n) for n in normals or []]
    for face in faces:
        corners = []
        for i in (k + 1 for k in face):
            corner = str(i)
            if uvs or normals:
                corner += f"/{i if uvs else ''}"
            if normals:
                corner += f"/{i}"
            corners.append(corner)
        lines.append("f " + " ".join(corners))
    (FOLDER / name).write_text("\n".join(lines) + "\n")


def write_ply(name, points, faces, uvs=None, normals=None, binary=True):
    fields = ["x", "y", "z"] + (["nx", "ny", "nz"] if normals else []) + (["u", "v"] if uvs else [])
    vertices = [
        tuple(p) + (tuple(normals[i]) if normals else ()) + (tuple(uvs[i]) if uvs else ())
        for i, p in enumerate(points)
    ]
    triangles = [t for f in faces for t in ((f[0], f[1], f[2]), (f[0], f[2], f[-1]))[: len(f) - 2]]
    header = [
        "ply",
        f"format {'binary_little_endian' if binary else 'ascii'} 1.0",
        f"element vertex {len(vertices)}",
    ]
    header += [f"property float {field}" for field in fields]
    header += [
        f"element face {len(triangles)}",
        "property list uchar int vertex_indices",
        "end_header",
    ]
    data = ("\n".join(header) + "\n").encode()
    if binary:
        data += b"".join(struct.pack(f"<{len(v)}f", *v) for v in vertices)
        data += b"".join(struct.pack("<B3i", 3, *t) for t in triangles)
    else:
        data += "".join(text(v) + "\n" for v in vertices).encode()
        data += "".join(f"3 {t[0]} {t[1]} {t[2]}\n" for t in triangles).encode()
    (FOLDER / name).write_bytes(data)


def main():
    FOLDER.mkdir(parents=True, exist_ok=True)
    points, uvs, quads = grid(24, 12, torus)
    write_obj("torus_smooth.obj", points, quads, uvs, normals_of(torus, uvs))
    points, uvs, quads = grid(12, 12, wave)
    write_ply("wave_bare.ply", points, quads, binary=False)
    write_obj("wave_bare.obj", points, quads)
    write_ply("wave_full.ply", points, quads, uvs, normals_of(wave, uvs))
    tetra = [(1, 1, 1), (1, -1, -1), (-1, 1, -1), (-1, -1, 1)]
    write_obj("tetra.obj", tetra, [(0, 1, 2), (0, 3, 1), (0, 2, 3), (1, 3, 2)])
    square = [(-1, -1, 0), (1, -1, 0), (1, 1, 0), (-1, 1, 0)]
    write_obj("square.obj", square, [(0, 1, 2, 3)], [(0, 0), (1, 0), (1, 1), (0, 1)])


if __name__ == "__main__":
    main()
