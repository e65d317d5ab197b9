#!/usr/bin/env python3
"""check.py CHECK ARGS...: looks at OpenEXR files by OpenEXR's own module; an error says what is wrong."""
import sys

import numpy
import OpenEXR


def channels(name):
    """Name to (type, values as stored)."""
    file = OpenEXR.InputFile(name)
    types = {channel: str(what.type) for channel, what in file.header()["channels"].items()}
    kinds = {"HALF": numpy.float16, "FLOAT": numpy.float32, "UINT": numpy.uint32}
    return {channel: (kind, numpy.frombuffer(file.channel(channel), kinds[kind])) for channel, kind in types.items()}


def header(name):
    return OpenEXR.InputFile(name).header()


def compression(name):
    return str(header(name)["compression"]).split(".")[-1].removesuffix("_COMPRESSION").lower()


def require(holds, what):
    if not holds:
        raise SystemExit(what)


def packed(wanted, name):
    found = compression(name)
    require(found in (wanted, {"none": "no"}.get(wanted)), f"it is {found}, not {wanted}")


def form(wanted, name, plain):
    """All in half but depth and the counts; what is kept is what the plain file has, rounded."""
    packed(wanted, name)
    ours, truth = channels(name), channels(plain)
    require(ours.keys() == truth.keys(), f"channels {sorted(ours)}")
    for channel, (kind, values) in ours.items():
        in_float = channel in ("depth.T", "samples.N")
        require(kind == ("FLOAT" if in_float else "HALF"), f"{channel} is {kind}")
        rounded = truth[channel][1].astype(values.dtype)
        lossy = wanted[:3] in ("b44", "dwa") and not in_float
        if lossy:
            require(numpy.abs(values - rounded).max() < 0.1, f"{channel} is another picture")
        else:
            require((values == rounded).all(), f"{channel} is not what was rendered")


if __name__ == "__main__":
    {"form": form, "packed": packed}[sys.argv[1]](*sys.argv[2:])
