"""Writes the small images of the comparison scenes (PNG of 8 bits and PFM; deterministic, no input)."""

import pathlib
import struct
import zlib

FOLDER = pathlib.Path(__file__).parent / "scenes" / "images"


def level(n):
    """0 to 255, no two neighbours alike."""
    return (n * 97 + n * n * 31) % 256


def png(width, height, components):
    """Rows of texels, of one component (grey) or three."""
    row = width * components
    rows = b"".join(
        b"\0" + bytes(level(y * row + k) for k in range(row)) for y in range(height)
    )

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


def main():
    FOLDER.mkdir(exist_ok=True)
    (FOLDER / "colors.png").write_bytes(png(7, 5, 3))
    (FOLDER / "grey.png").write_bytes(png(6, 4, 1))
    (FOLDER / "floats.pfm").write_bytes(pfm(4, 6))


if __name__ == "__main__":
    main()
