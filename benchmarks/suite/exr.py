"""Writes plain images of one colour as OpenEXR: the truth of scenes whose every pixel is known."""
import struct


def _attribute(name, kind, value):
    return name.encode() + b"\0" + kind.encode() + b"\0" + struct.pack("<i", len(value)) + value


def write_constant(path, width, height, colour):
    """float32 channels R, G, B, uncompressed, one line a block."""
    channels = b"".join(c + b"\0" + struct.pack("<iBBBBii", 2, 0, 0, 0, 0, 1, 1) for c in (b"B", b"G", b"R")) + b"\0"
    window = struct.pack("<iiii", 0, 0, width - 1, height - 1)
    header = struct.pack("<iI", 20000630, 2) + b"".join((
        _attribute("channels", "chlist", channels), _attribute("compression", "compression", b"\0"),
        _attribute("dataWindow", "box2i", window), _attribute("displayWindow", "box2i", window),
        _attribute("lineOrder", "lineOrder", b"\0"), _attribute("pixelAspectRatio", "float", struct.pack("<f", 1)),
        _attribute("screenWindowCenter", "v2f", struct.pack("<ff", 0, 0)),
        _attribute("screenWindowWidth", "float", struct.pack("<f", 1)))) + b"\0"
    red, green, blue = colour
    line = b"".join(struct.pack("<f", c) * width for c in (blue, green, red))
    first = len(header) + 8 * height
    offsets = b"".join(struct.pack("<Q", first + y * (8 + len(line))) for y in range(height))
    lines = b"".join(struct.pack("<ii", y, len(line)) + line for y in range(height))
    path.write_bytes(header + offsets + lines)
