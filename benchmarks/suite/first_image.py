"""compile: seconds from the start to the first image, with empty caches and with full ones."""
import shutil

from . import fits
from .context import check, say
from .renderer import render

SCENES = (("Cornell box", "cornell-box/scene.xml"), ("glass and metal", "glass-and-metal/scene.xml"),
          ("bunny, sky", "bunny/env.xml"))


def _empty_caches(context):
    """Empties the folders of everything that outlives a run, ours and PoCL's; returns what points there."""
    folders = {"PARHELION_CACHE_DIR": context.scratch / "parhelion", "POCL_CACHE_DIR": context.scratch / "pocl"}
    for folder in folders.values():
        shutil.rmtree(folder, ignore_errors=True)
        folder.mkdir()
    return {name: str(folder) for name, folder in folders.items()}


def _start(context, scene, environment):
    stats = render(context, scene, spp=1, threads=0, environment=environment)
    return {"process_seconds": stats["process_seconds"], "peak_bytes": stats["peak_bytes"],
            "compiler_peak_bytes": stats["memory"]["compiler_peak_bytes"],
            **{k: stats["time"][f"{k}_seconds"] for k in ("load", "bvh", "compile", "upload", "render", "write")},
            "cached": stats["time"]["compile_cached"]}


def first_image(context):
    result, checks = {"scenes": []}, []
    repeats = 1 if context.quick else 5
    for name, file in SCENES[:2] if context.quick else SCENES:
        say(f"compile: {name}")
        cold, warm = [], []
        for _ in range(repeats):
            environment = _empty_caches(context)
            cold.append(_start(context, context.scene(file), environment))
            warm += [_start(context, context.scene(file), environment) for _ in range(2)]
        result["scenes"].append({"name": name, "cold": _middle(cold), "warm": _middle(warm)})
    cornell = result["scenes"][0]
    checks.append(check("compile, Cornell box: seconds to a 1-spp image, second start",
                        cornell["warm"]["process_seconds"], most=0.3))
    checks.append(check("compile, Cornell box: seconds compiling, first start", cornell["cold"]["compile"], most=3,
                        note=f"{cornell['cold']['process_seconds']:.2f} s to the image; peak memory "
                             f"{cornell['cold']['peak_bytes'] / 1e6:.0f} MB, and "
                             f"{cornell['cold']['compiler_peak_bytes'] / 1e6:.0f} MB of the process that compiles "
                             f"beside it; with full caches {cornell['warm']['peak_bytes'] / 1e6:.0f} MB"))
    return result, checks


def _middle(starts):
    return {key: fits.median([s[key] for s in starts]) for key in starts[0]}
