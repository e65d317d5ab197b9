"""compile: seconds from the start to the first image, with empty caches and with full ones."""
import shutil

from . import fits
from .context import check, say
from .renderer import render

SCENES = (("Cornell box", "cornell-box/scene.xml"), ("glass and metal", "glass-and-metal/scene.xml"),
          ("bunny, sky", "bunny/env.xml"))


def _caches(context):
    """Folders of our own for everything that outlives a run: our cache and PoCL's."""
    folder = context.folder("caches")
    return folder, {"PARHELION_CACHE_DIR": str(folder / "parhelion"), "POCL_CACHE_DIR": str(folder / "pocl")}


def _start(context, scene, environment):
    (folder := context.folder("caches")).mkdir(exist_ok=True)
    for name in ("parhelion", "pocl"):
        (folder / name).mkdir(parents=True, exist_ok=True)
    stats = render(context, scene, spp=1, threads=0, environment=environment)
    return {"process_seconds": stats["process_seconds"], "peak_bytes": stats["peak_bytes"],
            **{k: stats["time"][f"{k}_seconds"] for k in ("load", "bvh", "compile", "upload", "render", "write")},
            "cached": stats["time"]["compile_cached"]}


def first_image(context):
    result, checks = {"scenes": []}, []
    repeats = 1 if context.quick else 5
    for name, file in SCENES[:2] if context.quick else SCENES:
        say(f"compile: {name}")
        folder, environment = _caches(context)
        cold, warm = [], []
        for _ in range(repeats):
            shutil.rmtree(folder, ignore_errors=True)
            cold.append(_start(context, context.scene(file), environment))
            warm += [_start(context, context.scene(file), environment) for _ in range(2)]
        result["scenes"].append({"name": name, "cold": _middle(cold), "warm": _middle(warm)})
    cornell = result["scenes"][0]
    checks.append(check("compile, Cornell box: seconds to a 1-spp image, second start",
                        cornell["warm"]["process_seconds"], most=0.3))
    checks.append(check("compile, Cornell box: seconds compiling, first start", cornell["cold"]["compile"], most=3,
                        note=f"{cornell['cold']['process_seconds']:.2f} s to the image; peak memory "
                             f"{cornell['cold']['peak_bytes'] / 1e6:.0f} MB"))
    return result, checks


def _middle(starts):
    return {key: fits.median([s[key] for s in starts]) for key in starts[0]}
