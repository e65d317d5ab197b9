"""Writes the small images of the comparison scenes (PNG of 8 bits and PFM), and a mesh with colours of its own;
deterministic, no input."""

import math
import pathlib
import struct
import zlib

FOLDER = pathlib.Path(__file__).parent / "scenes" / "images"


def level(n):
    """0 to 255, no two neighbours alike."""
    return (n * 97 + n * n * 31) % 256


def waves(x, y):
    """Heights and their slopes, of waves that repeat at 1."""
    tau = 2 * math.pi
    a, b = tau * (x + y), tau * (2 * x - y)
    height = 0.5 + 0.3 * math.sin(a) * math.cos(b)
    along_a, along_b = 0.3 * math.cos(a) * math.cos(b), -0.3 * math.sin(a) * math.sin(b)
    return height, tau * (along_a + 2 * along_b), tau * (along_a - along_b)


def normal(x, y):
    """Of lower waves, as a colour."""
    _, u, v = waves(x, y)
    n = [-0.12 * u, -0.12 * v, 1]
    length = math.hypot(*n)
    return [round(255 * (0.5 + 0.5 * c / length)) for c in n]


def png(width, height, components):
    """Rows of texels, of one component (grey) or three."""
    row = width * components
    return png_of(width, components, [[level(y * row + k) for k in range(row)] for y in range(height)])


def png_of(width, components, rows):
    height = len(rows)
    rows = b"".join(b"\0" + bytes(row) for row in rows)

    def chunk(name, content):
        body = name + content
        return struct.pack(">I", len(content)) + body + struct.pack(">I", zlib.crc32(body))

    header = struct.pack(">IIBBBBB", width, height, 8, 0 if components == 1 else 2, 0, 0, 0)
    return (
        b"\x89PNG\r\n\x1a\n"
        + chunk(b"IHDR", header)
        + chunk(b"IDAT", zlib.compress(rows, 9))
        + chunk(b"IEND", b"")
    )


def pfm(width, height):
    """Colours from 0.1 to 0.9, the bottom row first."""
    values = [0.1 + 0.8 * level(k) / 255 for k in range(3 * width * height)]
    return f"PF\n{width} {height}\n-1.0\n".encode() + struct.pack(f"<{len(values)}f", *values)


def sky(width, height):
    """A sky (PFM): dim and uneven, with a sun of four texels, black beside it, and a bright pole."""
    values = []
    for y in reversed(range(height)):
        for x in range(width):
            for c in range(3):
                value = 0.05 + 0.4 * level(3 * (y * width + x) + c) / 255
                if y in (3, 4) and x in (5, 6):
                    value = (90, 70, 40)[c]
                elif y in (3, 4) and x in (7, 8, 9):
                    value = 0
                elif y == 0:
                    value = 1.5
                values.append(value)
    return f"PF\n{width} {height}\n-1.0\n".encode() + struct.pack(f"<{len(values)}f", *values)


def colored_mesh(side):
    """A square of side x side pairs of triangles with colours at its vertices and numbers of its faces (PLY)."""
    vertices, faces = [], []
    for row in range(side + 1):
        for column in range(side + 1):
            n = row * (side + 1) + column
            color = [0.1 + 0.8 * level(3 * n + c) / 255 for c in range(3)]
            vertices.append([2 * column / side - 1, 2 * row / side - 1, 0, *color])
            if row < side and column < side:
                faces += [(n, n + 1, n + side + 2), (n, n + side + 2, n + side + 1)]
    names = ["x", "y", "z", "tint_0", "tint_1", "tint_2"]
    lines = ["ply", "format ascii 1.0", f"element vertex {len(vertices)}"]
    lines += [f"property float {name}" for name in names]
    lines += [f"element face {len(faces)}", "property list uchar int vertex_indices"]
    lines += ["property float grey_0", "end_header"]
    lines += [" ".join(f"{v:g}" for v in vertex) for vertex in vertices]
    lines += [f"3 {a} {b} {c} {0.1 + 0.8 * level(a + 7 * b) / 255:g}" for a, b, c in faces]
    return "\n".join(lines) + "\n"


def main():
    FOLDER.mkdir(exist_ok=True)
    (FOLDER / "colors.png").write_bytes(png(7, 5, 3))
    (FOLDER / "grey.png").write_bytes(png(6, 4, 1))
    (FOLDER / "sky.pfm").write_bytes(sky(16, 9))
    centres = [(n + 0.5) / 16 for n in range(16)]
    heights = [[round(255 * waves(x, y)[0]) for x in centres] for y in centres]
    (FOLDER / "heights.png").write_bytes(png_of(16, 1, heights))
    normals = [[c for x in centres for c in normal(x, y)] for y in centres]
    (FOLDER / "normals.png").write_bytes(png_of(16, 3, normals))
    (FOLDER / "floats.pfm").write_bytes(pfm(4, 6))
    (FOLDER.parent / "meshes" / "colored.ply").write_text(colored_mesh(3))


if __name__ == "__main__":
    main()
