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


def same_values(name, other):
    ours, truth = channels(name), channels(other)
    require(ours.keys() == truth.keys(), f"channels {sorted(ours)}")
    for channel, (_, values) in ours.items():
        require(values.tobytes() == truth[channel][1].tobytes(), f"{channel} differs")


def groups(name, plain, *wanted):
    """The groups are there and no others; they add up to the image, which is that without them."""
    ours, truth = channels(name), channels(plain)
    there = {channel.split(".")[1] for channel in ours if channel.startswith("light.")}
    require(there == set(wanted), f"groups {sorted(there)}")
    for color in "RGB":
        image = ours[color][1].astype(numpy.float64)
        require((ours[color][1] == truth[color][1]).all(), f"{color} is not the image without groups")
        layers = [ours[f"light.{group}.{color}"][1].astype(numpy.float64) for group in wanted]
        require(all((layer != 0).any() for layer in layers), f"a group is black in {color}")
        off = numpy.abs(sum(layers) - image) / image
        require(off.max() < 16 * 2.0**-24, f"{color}: the sum of groups is off by {off.max()}")


if __name__ == "__main__":
    {"form": form, "groups": groups, "packed": packed, "same_values": same_values}[sys.argv[1]](*sys.argv[2:])
