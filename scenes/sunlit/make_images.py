"""Writes the images of these scenes: a sky with a small sun (PFM) and one without (HDR), tiles, their heights and a lattice (PNG);
deterministic, no input."""

import math
import pathlib
import struct
import zlib

FOLDER = pathlib.Path(__file__).parent / "images"
SKY_WIDTH, SKY_HEIGHT = 128, 65
SUN = (40, 17)  # column and row of its first of two by two texels
SIDE = 64  # of tiles and lattice


def mixed(a, b, t):
    return [x + (y - x) * t for x, y in zip(a, b)]


def sunny(x, y):
    inside = SUN[0] <= x < SUN[0] + 2 and SUN[1] <= y < SUN[1] + 2
    return [9000.0, 8100.0, 6600.0] if inside else cloudy(x, y)


def cloudy(x, y):
    """Linear sRGB: blue overhead, pale at the horizon, clouds, earth below."""
    height = 1 - 2 * y / (SKY_HEIGHT - 1)
    if height < 0:
        return mixed([0.22, 0.2, 0.17], [0.1, 0.08, 0.06], min(1.0, -3 * height))
    turn = 2 * math.pi * x / SKY_WIDTH
    cloud = math.sin(3 * turn + 9 * height) + math.sin(7 * turn - 14 * height) + math.sin(13 * turn + 31 * height)
    cover = max(0.0, min(1.0, 0.45 * cloud - 0.2)) * min(1.0, 4 * height)
    blue = mixed([0.75, 0.85, 0.95], [0.1, 0.25, 0.6], height**0.6)
    near_sun = math.exp(-((x - SUN[0] - 0.5) ** 2 + (y - SUN[1] - 0.5) ** 2) / 60)
    return mixed(mixed(blue, [1.1, 1.1, 1.1], cover), [2.5, 2.2, 1.8], near_sun)


def pfm(texel):
    rows = reversed(range(SKY_HEIGHT))
    values = [c for y in rows for x in range(SKY_WIDTH) for c in texel(x, y)]
    return f"PF\n{SKY_WIDTH} {SKY_HEIGHT}\n-1.0\n".encode() + struct.pack(f"<{len(values)}f", *values)


def rgbe(color):
    """Three mantissas of 8 bits and their common exponent."""
    exponent = math.frexp(max(color))[1]
    return [min(255, int(c * 2.0 ** (8 - exponent))) for c in color] + [exponent + 128]


def hdr(texel):
    head = f"#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y {SKY_HEIGHT} +X {SKY_WIDTH}\n"
    return head.encode() + bytes(b for y in range(SKY_HEIGHT) for x in range(SKY_WIDTH) for b in rgbe(texel(x, y)))


def png(components, rows):
    """Rows of bytes, of one component a texel (grey) or three."""

    def chunk(name, content):
        body = name + content
        return struct.pack(">I", len(content)) + body + struct.pack(">I", zlib.crc32(body))

    width = len(rows[0]) // components
    header = struct.pack(">IIBBBBB", width, len(rows), 8, 0 if components == 1 else 2, 0, 0, 0)
    content = zlib.compress(b"".join(b"\0" + bytes(row) for row in rows), 9)
    return b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", header) + chunk(b"IDAT", content) + chunk(b"IEND", b"")


def grain(x, y):
    """0 to 1, no two neighbours alike."""
    return ((x * 97 + y * 57 + x * y * 31) % 101) / 101


def joint(x, y):
    """How deep in the joint between four tiles: 0 on them, 1 in its middle."""
    half = SIDE // 2
    away = min(min(x % half, half - x % half), min(y % half, half - y % half))
    return max(0.0, 1 - away / 2.5)


def tile(x, y):
    half = SIDE // 2
    tones = [[168, 120, 92], [150, 104, 84], [178, 134, 104], [140, 110, 92]]
    tone = tones[(x // half) + 2 * (y // half)]
    shade = 0.9 + 0.1 * grain(x, y)
    return [round(c) for c in mixed([t * shade for t in tone], [90, 86, 80], joint(x, y))]


def height(x, y):
    return round(255 * (0.9 - 0.9 * joint(x, y) + 0.08 * grain(x, y)))


def lattice(x, y):
    """Opacity of bars that cross."""
    a, b = (x + y) % 16, (x - y) % 16
    return 255 if a < 5 or b < 5 else 0


def main():
    FOLDER.mkdir(exist_ok=True)
    texels = range(SIDE)
    (FOLDER / "sky.pfm").write_bytes(pfm(sunny))
    (FOLDER / "clouds.hdr").write_bytes(hdr(cloudy))
    (FOLDER / "tiles.png").write_bytes(png(3, [[c for x in texels for c in tile(x, y)] for y in texels]))
    (FOLDER / "heights.png").write_bytes(png(1, [[height(x, y) for x in texels] for y in texels]))
    (FOLDER / "lattice.png").write_bytes(png(1, [[lattice(x, y) for x in texels] for y in texels]))


if __name__ == "__main__":
    main()
