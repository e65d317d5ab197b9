"""Renders a case with Mitsuba 3 (scalar_rgb, one thread) in several seeds and keeps the result."""

import contextlib
import hashlib
import importlib
import json
import pathlib
import time

import drjit
import mitsuba
import numpy as np

mitsuba.set_variant("scalar_rgb")
mitsuba.set_log_level(mitsuba.LogLevel.Error)
drjit.set_thread_count(1)
importlib.import_module("old_bsdfs")  # once there is a variant

SUPERSAMPLING = 12  # sub-pixels a side, for filters


@contextlib.contextmanager
def reading_threads():
    """With one thread, Mitsuba's reader of EXR files never returns."""
    drjit.set_thread_count(2)
    try:
        yield
    finally:
        drjit.set_thread_count(1)


def load(scene, parameters, supersampling=1):
    """The scene with the robust intersection flag and a float32 film.

    Meshes are not merged (that would renumber primitives). With supersampling: a box filter and
    that many times the size in each direction.
    """
    with reading_threads():
        return _loaded(scene, parameters, supersampling)


def _loaded(scene, parameters, supersampling):
    config = mitsuba.parser.ParserConfig("scalar_rgb")
    config.merge_meshes = False
    config.merge_equivalent = False
    mitsuba.file_resolver().prepend(str(scene.parent))
    state = mitsuba.parser.parse_file(config, str(scene), **parameters)
    mitsuba.parser.transform_all(config, state)
    state.root.props["embree_use_robust_intersections"] = True
    for node in state.nodes:
        if node.type == mitsuba.ObjectType.Film:
            node.props["component_format"] = "float32"
            if supersampling > 1:
                for side in ("width", "height"):
                    node.props[side] = node.props[side] * supersampling
        if node.type == mitsuba.ObjectType.ReconstructionFilter and supersampling > 1:
            plain = mitsuba.Properties("box")
            plain.set_id(node.props.id())
            node.props = plain
    loaded = mitsuba.parser.instantiate(config, state)
    return loaded[0] if isinstance(loaded, list) else loaded


def channels_of(bitmap):
    """A Mitsuba bitmap as dict: channel name -> (H, W) in double."""
    data = np.array(bitmap, dtype=np.float64)
    if data.ndim == 2:
        data = data[..., None]
    return {field.name: data[..., i] for i, field in enumerate(bitmap.struct_())}


def read_exr(path):
    """An EXR file as channel name -> (H, W)."""
    with reading_threads():
        return channels_of(mitsuba.Bitmap(str(path)))


def filter_weights(kind, x, stddev=0.5, radius=1.0, B=1 / 3, C=1 / 3, lobes=3):
    """f(x) by its definition (not by Mitsuba's table), x in pixels, any constant factor."""
    x = np.abs(x)
    if kind == "box":
        return (x < 0.5).astype(float)
    if kind == "tent":
        return np.maximum(0, 1 - x / radius)
    if kind == "gaussian":
        return np.maximum(0, np.exp(-(x**2) / (2 * stddev**2)) - np.exp(-8.0))
    if kind == "lanczos":
        return np.where(x < lobes, np.sinc(x) * np.sinc(x / lobes), 0)
    if kind == "catmullrom":
        B, C = 0.0, 0.5
    near = ((12 - 9 * B - 6 * C) * x**3 + (-18 + 12 * B + 6 * C) * x**2 + (6 - 2 * B)) / 6
    far = (
        (-B - 6 * C) * x**3 + (6 * B + 30 * C) * x**2 + (-12 * B - 48 * C) * x + (8 * B + 24 * C)
    ) / 6
    return np.where(x < 1, near, np.where(x < 2, far, 0))


def filter_matrix(pixels, spec):
    """(pixels, pixels * SUPERSAMPLING): normalised weights, each averaged over its sub-pixel."""
    inner = 16
    fine = (np.arange(pixels * SUPERSAMPLING * inner) + 0.5) / (SUPERSAMPLING * inner)
    centres = np.arange(pixels) + 0.5
    parameters = {key: value for key, value in spec.items() if key != "kind"}
    weights = filter_weights(spec["kind"], fine[None] - centres[:, None], **parameters)
    weights = weights.reshape(pixels, pixels * SUPERSAMPLING, inner).mean(2)
    return weights / weights.sum(1, keepdims=True)


def render_seed(scene, spp, seed, filter_spec):
    mitsuba.render(scene, spp=spp, seed=seed)
    image = channels_of(scene.sensors()[0].film().bitmap())
    if not filter_spec:
        return image
    height, width = (side // SUPERSAMPLING for side in next(iter(image.values())).shape)
    rows, columns = filter_matrix(height, filter_spec), filter_matrix(width, filter_spec)
    return {name: rows @ channel @ columns.T for name, channel in image.items()}


def fingerprint(case, folder, spp, seeds):
    """Changes when anything the reference depends on does: files, parameters, samples, Mitsuba."""
    digest = hashlib.sha256(
        json.dumps(
            [
                case.get("parameters"),
                case.get("filter"),
                spp,
                seeds,
                SUPERSAMPLING,
                mitsuba.__version__,
            ]
        ).encode()
    )
    for path in sorted(pathlib.Path(folder).rglob("*")):
        if path.is_file() and (
            path.suffix != ".xml"
            or path.name == pathlib.Path(case["scene"]).name
            or path.parent.name == "parts"
        ):
            digest.update(path.name.encode() + path.read_bytes())
    return digest.hexdigest()[:16]


def render(case, base, spp, seeds, cache=None):
    """The case in len(seeds) renders that share spp samples a pixel.

    Returns (dict channel -> (S, H, W), seconds).
    """
    scene_file = (base / case["scene"]).resolve()
    kept = None
    if cache:
        kept = (
            pathlib.Path(cache)
            / f"{case['name']}-{fingerprint(case, scene_file.parent, spp, seeds)}.npz"
        )
        if kept.exists():
            with np.load(kept) as data:
                return {name: data[name] for name in data.files}, 0.0
    begin = time.monotonic()
    supersampling = SUPERSAMPLING if case.get("filter", {}).get("kind", "box") != "box" else 1
    scene = load(scene_file, case.get("parameters", {}), supersampling)
    each = max(1, spp // (len(seeds) * supersampling**2))
    images = [
        render_seed(scene, each, seed, case.get("filter") if supersampling > 1 else None)
        for seed in seeds
    ]
    stacks = {name: np.stack([image[name] for image in images]) for name in images[0]}
    if kept:
        kept.parent.mkdir(parents=True, exist_ok=True)
        np.savez(kept, **stacks)
    return stacks, time.monotonic() - begin
