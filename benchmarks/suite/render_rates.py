"""render: how many paths and rays a second, where the time goes, and how it grows."""
from concurrent.futures import ThreadPoolExecutor

from . import fits, scenes
from .context import check, say, thread_counts
from .renderer import kernel_seconds, render

POOL_PATHS = 65536  # the program's --pool-paths

# The shading prototype's cost, ns a vertex on one core of the machine it was made on (16 lanes).
PROTOTYPE_NS = {"diffuse": 23, "GGX": 32, "glass": 24, "many materials": 36}
QUICK_MATERIALS = ("diffuse", "GGX", "glass")


def _middle(context, scene, repeats, **options):
    """The run in the middle of the repeats, by render seconds."""
    runs = sorted((render(context, scene, **options) for _ in range(repeats)),
                  key=lambda s: s["time"]["render_seconds"])
    return runs[(len(runs) - 1) // 2]


def _row(name, stats):
    counts, seconds = stats["counts"], kernel_seconds(stats)
    vertices = counts["camera_rays"] + counts["bounce_rays"]
    per = {"generate": counts["paths"], "accumulate": counts["paths"], "intersect": vertices, "shade": vertices,
           "shadow": counts["shadow_rays"]}
    whole = sum(seconds.values())
    return {"name": name, "seconds": stats["time"]["render_seconds"],
            "mpaths_per_second": stats["rates"]["paths_per_second"] / 1e6,
            "mrays_per_second": stats["rates"]["rays_per_second"] / 1e6,
            "vertices_per_path": vertices / counts["paths"],
            "share": {n: s / whole for n, s in seconds.items()},
            "ns": {n: 1e9 * s / per[n] if per[n] else None for n, s in seconds.items()},
            "kernel_seconds": seconds, "other_seconds": stats["time"]["render_seconds"] - whole,
            "pool_bytes": stats["memory"]["device_pool_bytes"],
            "pool_bytes_per_path": stats["memory"]["device_pool_bytes"] / POOL_PATHS,
            "scene_bytes": stats["memory"]["device_scene_bytes"], "primitives": counts["primitives"],
            "lights": counts["lights"], "host_peak_bytes": stats["memory"]["host_peak_bytes"]}


def _rest_over_traversal(row):
    s = row["kernel_seconds"]
    return (s["generate"] + s["shade"] + s["accumulate"]) / (s["intersect"] + s["shadow"])


def _named_scenes(context):
    folder = context.folder("scenes")
    yield "Cornell box", context.scene("cornell-box/scene.xml")
    yield "glass and metal", context.scene("glass-and-metal/scene.xml")
    yield "bunny, sky", context.scene("bunny/env.xml")
    yield "bunny, point light", context.scene("bunny/point.xml")
    yield "many materials", scenes.many_materials(folder)
    for name in QUICK_MATERIALS if context.quick else scenes.MATERIALS:
        yield f"room of {name}", scenes.material_room(folder, name)


def rates(context):
    spp, repeats = (4, 1) if context.quick else (16, 5)
    result = {"scenes": [], "threads": [], "resolution": [], "depth": [], "triangles": [], "emitters": []}
    for name, scene in _named_scenes(context):
        say(f"render: {name}")
        render(context, scene, spp=1, size=64)  # compiles
        result["scenes"].append(_row(name, _middle(context, scene, repeats, spp=spp)))
    checks = _checks_of_stages(result["scenes"])
    cornell = context.scene("cornell-box/scene.xml")
    result["threads"], more = _threads(context, cornell, spp)
    checks += more
    result["resolution"], more = _resolution(context, cornell)
    checks += more
    for depth in (2, 3, 5, 10, 20, 50, -1):
        row = _row(f"depth {depth}", render(context, cornell, spp=spp, options=["--max-depth", depth]))
        result["depth"].append({"max_depth": depth, **row})
    folder = context.folder("scenes")
    for triangles in (10_000, 100_000, 1_000_000) + (() if context.quick else (10_000_000,)):
        say(f"render: {triangles} triangles")
        row = _row(f"{triangles} triangles", render(context, scenes.hills(folder, triangles), spp=spp))
        result["triangles"].append(row)
    result["lookups"] = _lookups(context, spp)
    if not context.quick:
        checks.append(check("render, 10 M triangles: peak memory of the process, GiB",
                            result["triangles"][-1]["host_peak_bytes"] / 2**30, most=24))
    for lamps in (1, 10, 100, 1000) + (() if context.quick else (10_000,)):
        say(f"render: {lamps} lamps")
        stats = render(context, scenes.many_lamps(folder, lamps), spp=spp)
        result["emitters"].append({"lamps": lamps, **_row(f"{lamps} lamps", stats)})
    return result, checks


def _checks_of_stages(rows):
    by_name = {row["name"]: row for row in rows}
    return [check("render, Cornell box: generate + shade + accumulate over traversal",
                  _rest_over_traversal(by_name["Cornell box"]), most=0.6),
            check("render, many materials: generate + shade + accumulate over traversal",
                  _rest_over_traversal(by_name["many materials"]), most=1.0),
            *(check(f"render, shading a vertex, {name}: ns", by_name[scene]["ns"]["shade"], most=most,
                    note="the prototype's")
              for name, most in PROTOTYPE_NS.items()
              for scene in (f"room of {name}", name) if scene in by_name)]


def _lookups(context, spp):
    """What textures and environment maps take: nanoseconds of shading by which a vertex is dearer than without, the
    median of pairs of runs."""
    folder = context.folder("scenes")
    plain_room, plain_hills = scenes.material_room(folder, "diffuse"), scenes.hills(folder, 10_000)
    sky = scenes.hills(folder, 10_000, scenes.sky_of(context.scene("sunlit/images/sky.pfm")), "hills-in-the-sun")
    pairs = [(f"a texture of {side}x{side}, 8-bit RGB, bilinear", plain_room, scenes.textured_room(folder, side))
             for side in (64, 4096)]
    pairs.append(("an environment map of 128x65, sampled and met, instead of a uniform sky", plain_hills, sky))
    rows = []
    for name, plain, dearer in pairs:
        say(f"render: {name}")
        for scene in (plain, dearer):
            render(context, scene, spp=1, size=64)  # compiles
        runs = [[_row("", render(context, scene, spp=spp, size=256))["ns"]["shade"] for scene in (plain, dearer)]
                for _ in range(1 if context.quick else 5)]
        rows.append({"name": name, "ns": fits.median([b - a for a, b in runs]),
                     "shade_ns": fits.median([a for a, _ in runs])})
    return rows


def _threads(context, scene, spp):
    """Runs of one round stand side by side, so that what the machine does beside falls on all: one thread, all threads,
    and as many processes of one thread each at once, which have nothing to share or to wait for but the machine."""
    counts = thread_counts()
    if len(counts) < 2:
        return [], []
    rows = []
    for _ in range(3 if context.quick else 7):
        row = {f"{t} threads": _row("", render(context, scene, spp=spp, threads=t))["mrays_per_second"] for t in counts}
        row[f"{counts[-1]} processes"] = _mrays_of_processes(context, scene, spp, counts[-1])
        rows.append(row)
    one, many, apart = ([row[name] for row in rows] for name in rows[0])
    return rows, [
        check(f"render, Cornell box: rays of {counts[-1]} threads over 1",
              fits.median([m / o for m, o in zip(many, one)]), least=1.8,
              note=f"as many processes of one thread each: {fits.median([a / o for a, o in zip(apart, one)]):.2f}"),
        check(f"render, Cornell box: rays of {counts[-1]} threads over as many processes of one each",
              fits.median([m / a for m, a in zip(many, apart)]), least=1.8 / 2)]


def _mrays_of_processes(context, scene, spp, count):
    with ThreadPoolExecutor(count) as pool:
        runs = pool.map(lambda k: render(context, scene, spp=spp, output=context.scratch / f"process-{k}.exr"),
                        range(count))
        return sum(run["rates"]["rays_per_second"] / 1e6 for run in runs)


def _resolution(context, scene):
    sizes = (256, 512, 1024) if context.quick else (256, 512, 1024, 2048)
    runs = [[render(context, scene, spp=4, size=size) for size in sizes] for _ in range(1 if context.quick else 5)]
    ratios = [[b["time"]["render_seconds"] / a["time"]["render_seconds"] for a, b in zip(r, r[1:])] for r in runs]
    ratios = [fits.median(column) for column in zip(*ratios)]
    rows = [{"size": size, **_row(f"{size}x{size}", s)} for size, s in zip(sizes, runs[0])]
    pools = [row["pool_bytes"] for row in rows]
    checks = [check(f"render, Cornell box: seconds at {b} over {a} pixels a side", ratio, most=4.1)
              for a, b, ratio in zip(sizes, sizes[1:], ratios)]
    checks.append(check("render: bytes of the path pool, largest over smallest resolution", pools[-1] / pools[0],
                        most=1))
    return rows, checks
