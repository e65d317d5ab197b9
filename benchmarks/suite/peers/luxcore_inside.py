"""Runs in a Python that has pyluxcore: renders one scene file with PATHCPU, with several samples and seeds.

Plain path tracing: no clamp, no denoiser, no adaptive sampling, box filter, Sobol sampler.
"""
import json
import math
import pathlib
import sys
import time

import pyluxcore

sys.path.append(str(pathlib.Path(__file__).parent))
from job_list import run_jobs  # noqa: E402
from mitsuba_xml import Refused, point, read_scene  # noqa: E402


def material(name, m):
    """Properties of a material; its emission is a radiance."""
    key = f"scene.materials.{name}"
    if "texture" in m:
        raise Refused("textures (not translated for it)")
    if m["kind"] == "diffuse":
        return {f"{key}.type": ["matte"], f"{key}.kd": list(m["colour"])}
    if m["kind"] == "glass":
        return {f"{key}.type": ["glass"], f"{key}.kr": [1.0] * 3, f"{key}.kt": [1.0] * 3,
                f"{key}.interiorior": [m["ior"]], f"{key}.exteriorior": [1.0]}
    if m["kind"] == "light":
        return {f"{key}.type": ["matte"], f"{key}.kd": [0.0] * 3, f"{key}.emission": list(m["colour"])}
    raise Refused(f"{m['kind']} with the GGX distribution (it has another)")


def sphere(centre, radius, rings=200):
    """A ball of triangles with smooth normals."""
    vertices, normals, faces = [], [], []
    for j in range(rings + 1):
        for i in range(2 * rings):
            a, b = math.pi * i / rings, math.pi * j / rings
            n = (math.sin(b) * math.cos(a), math.cos(b), math.sin(b) * math.sin(a))
            normals.append(n)
            vertices.append(tuple(c + radius * x for c, x in zip(centre, n)))
    for j in range(rings):
        for i in range(2 * rings):
            a, b = 2 * rings * j + i, 2 * rings * j + (i + 1) % (2 * rings)
            faces += [(a, b, b + 2 * rings), (a, b + 2 * rings, a + 2 * rings)]
    return vertices, normals, faces


def build(description, size):
    scene, values = pyluxcore.Scene(), {}
    shapes = [(m["vertices"], None, m["faces"], m["material"]) for m in description["meshes"]]
    shapes += [(*sphere(s["centre"], s["radius"]), s["material"]) for s in description["spheres"]]
    for i, (vertices, normals, faces, look) in enumerate(shapes):
        values.update(material(f"m{i}", look))
        scene.DefineMesh(f"mesh{i}", vertices, faces, normals, None, None, None)
        values[f"scene.objects.o{i}.shape"] = [f"mesh{i}"]
        values[f"scene.objects.o{i}.material"] = [f"m{i}"]
    for i, lamp in enumerate(description["points"]):
        key = f"scene.lights.p{i}"
        values.update({f"{key}.type": ["point"], f"{key}.position": list(lamp["position"]),
                       f"{key}.color": list(lamp["intensity"]), f"{key}.gain": [4 * math.pi] * 3})
    if description["envmap"]:
        raise Refused("environment maps (not translated for it)")
    if any(description["sky"]):
        values.update({"scene.lights.sky.type": ["constantinfinite"], "scene.lights.sky.color":
                       list(description["sky"])})
    m = description["to_world"]
    values.update({"scene.camera.type": ["perspective"], "scene.camera.lookat.orig": list(point(m, (0, 0, 0))),
                   "scene.camera.lookat.target": list(point(m, (0, 0, 1))),
                   "scene.camera.up": [m[i][1] for i in range(3)],
                   "scene.camera.fieldofview": [description["fov"]],
                   # Its pictures begin one row lower than others'.
                   "scene.camera.screenwindow": [-1.0, 1.0, -1.0 - 2.0 / size, 1.0 - 2.0 / size]})
    scene.Parse(properties(values))
    return scene


def properties(values):
    made = pyluxcore.Properties()
    for key, value in values.items():
        made.Set(pyluxcore.Property(key, value))
    return made


def settings(order, job):
    return properties({
        "renderengine.type": ["PATHCPU"], "renderengine.seed": [job["seed"]],
        "native.threads.count": [order["threads"]], "sampler.type": ["SOBOL"], "sampler.sobol.adaptive.strength": [0.0],
        "path.pathdepth.total": [order["max_depth"]], "path.pathdepth.diffuse": [order["max_depth"]], "path.pathdepth.glossy": [order["max_depth"]],
        "path.pathdepth.specular": [order["max_depth"]], "path.clamping.variance.maxvalue": [0.0],
        "path.clamping.radiance.maxvalue": [0.0],
        "film.width": [order["size"]], "film.height": [order["size"]],
        "film.filter.type": ["BOX"], "film.filter.width": [0.5], "film.imagepipelines.0.0.type": ["NOP"],
        "film.outputs.0.type": ["RGB"], "film.outputs.0.filename": [job["output"]],
        "film.noiseestimation.warmup": [1 << 24], "batch.haltspp": [job["spp"]], "batch.halttime": [0]})


def render(scene, order, job):
    begin = time.perf_counter()
    session = pyluxcore.RenderSession(pyluxcore.RenderConfig(settings(order, job), scene))
    session.Start()  # builds its tree
    start = time.perf_counter()
    while not session.HasDone():
        time.sleep(0.001)
        session.UpdateStats()
    seconds = time.perf_counter() - start
    session.Stop()
    session.GetFilm().SaveOutput(job["output"], pyluxcore.FilmOutputType.RGB, pyluxcore.Properties())
    return {"seconds": seconds, "busy_seconds": time.perf_counter() - begin}


def main():
    order = json.loads(sys.argv[-1])
    pyluxcore.Init()
    try:
        description = read_scene(order["scene"])
        scene = build(description, order["size"])
    except Refused as e:
        print(f"REFUSED LuxCore cannot be given {e}", flush=True)
        return
    order["max_depth"] = description["max_depth"]
    for _, result in run_jobs(order, lambda job: render(scene, order, job)):
        print("RESULT", json.dumps(result), flush=True)


main()
