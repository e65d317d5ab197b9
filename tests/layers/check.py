#!/usr/bin/env python3
"""check.py CHECK ARGS...: looks at OpenEXR files by OpenEXR's own module; an error says what is wrong."""
import json
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


def float_id(name):
    """As Cryptomatte's specification has it, of a hash that is not ours; None where there is none."""
    try:
        import mmh3
    except ImportError:
        return None
    bits = mmh3.hash(name.encode(), 0, signed=False)
    if bits >> 23 & 255 in (0, 255):
        bits ^= 1 << 23
    return bits


def check_header(name, layer, names):
    """One layer of that name, with a manifest of at least these names and their hashes."""
    found = {}
    for key, value in header(name).items():
        if key.startswith("cryptomatte/"):
            _, key, what = key.split("/", 2)
            found.setdefault(key, {})[what] = value.decode() if isinstance(value, bytes) else value
    (key, about), = [(k, a) for k, a in found.items() if a["name"] == layer]
    require(about["hash"] == "MurmurHash3_32" and about["conversion"] == "uint32_to_float32", str(about))
    manifest = json.loads(about["manifest"])
    require(set(names) <= manifest.keys(), f"manifest {manifest}")
    if float_id(layer) is not None:
        require(key == f"{float_id(layer):08x}"[:7], f"key {key}")
        for of_name, bits in manifest.items():
            require(bits == f"{float_id(of_name):08x}", f"{of_name} is {bits}")
    return {int(bits, 16): of_name for of_name, bits in manifest.items()}


def ranks(layers, layer):
    """Of each rank the bits of ids, and the shares."""
    for k in range(3):
        for of_id, of_share in ("RG", "BA"):
            kind, ids = layers[f"{layer}{k:02}.{of_id}"]
            require(kind == "FLOAT", f"{layer}{k:02} is {kind}")
            yield ids.view(numpy.uint32), layers[f"{layer}{k:02}.{of_share}"][1].astype(numpy.float64)


def mattes(name, rfilter, *shapes):
    """Mattes by name: shares of shapes make the mean of their numbers, and those of materials are sums of them."""
    layers = channels(name)
    named = check_header(name, "CryptoObject", shapes)
    materials = check_header(name, "CryptoMaterial", ("paint", "default", "tin"))
    of_shape = {shape: 0.0 for shape in shapes}
    before = numpy.inf
    for ids, shares in ranks(layers, "CryptoObject"):
        require(set(ids.tolist()) <= named.keys() | {0}, "an id that is in no manifest")
        require(((ids == 0) == (shares == 0)).all() and (shares >= 0).all() and (shares <= before).all(), "ranks")
        before = shares
        for bits, shape in named.items():
            of_shape[shape] = of_shape[shape] + numpy.where(ids == bits, shares, 0)
    require(all((matte > 0).any() for matte in of_shape.values()), "a shape is nowhere")
    paint = sum(numpy.where(ids == bits, shares, 0) for ids, shares in ranks(layers, "CryptoMaterial")
                for bits, of_name in materials.items() if of_name == "paint")
    if rfilter != "lanczos":  # whose lobes below 0 have no rank
        mean = sum((k + 1) * of_shape[shape] for k, shape in enumerate(shapes))
        off = numpy.abs(mean - layers["shape_index.I"][1]).max()
        require(off < 1e-5, f"the mean of shape numbers is off by {off}")
        require(numpy.abs(paint - of_shape[shapes[0]] - of_shape[shapes[1]]).max() < 1e-6, "paint is no sum")
    by_another_program(name, of_shape)


def by_another_program(name, of_shape):
    try:
        import cryptomatte_api
    except ImportError:
        return
    (reader,) = [m for m in cryptomatte_api.Cryptomatte.load(name, load_preview=False)
                 if m.metadata().name() == "CryptoObject"]
    for shape, matte in of_shape.items():
        theirs = numpy.asarray(reader.mask(shape)).reshape(-1)
        require(numpy.abs(theirs - matte).max() < 1e-6, f"the matte of {shape} is another one")


def crop(name, whole, x, y, width, height):
    """A crop has the values of the whole there."""
    ours, all_of_it = channels(name), channels(whole)
    full = header(whole)["dataWindow"]
    columns = full.max.x - full.min.x + 1
    x, y, width, height = int(x), int(y), int(width), int(height)
    for channel, (_, values) in ours.items():
        there = all_of_it[channel][1].reshape(-1, columns)[y:y + height, x:x + width]
        require(values.reshape(height, width).tobytes() == there.tobytes(), f"{channel} differs")


if __name__ == "__main__":
    checks = (crop, form, groups, mattes, packed, same_values)
    {check.__name__: check for check in checks}[sys.argv[1]](*sys.argv[2:])
