"""traversal and build: what parhelion_bench measures in one process, for each number of threads."""
import json

from . import fits
from .context import check, run, say, thread_counts

# Against Embree's best call in default mode on the large scene; 1 elsewhere.
LEAST_ON_LANDSCAPE = {"bounce 1": 1.25, "bounce 2": 1.8, "shadow from bounce 1": 1.8}
LEAST_AGAINST_ROBUST = 1.4
LEAST_OF_TWO_THREADS = 1.8


def _run_native(context, name, threads, *options):
    command = [context.native, name, "--threads", threads, *options]
    if context.quick:
        command.append("--quick")
    return json.loads(run(command, {"POCL_MAX_PTHREAD_COUNT": str(threads)}, show_progress=True).stdout)


def traversal(context):
    runs = []
    for threads in thread_counts():
        say(f"traversal with {threads} thread(s)")
        options = ["--processor-time"] if context.processor_time and threads == 1 else []
        runs.append(_run_native(context, "traversal", threads, *options))
    checks = [c for scene in runs[0]["scenes"] for s in scene["sets"] for c in _checks_of_set(scene, s)]
    if len(runs) > 1:
        checks += _checks_of_threads(*runs)
    return {"runs": runs}, checks


def _checks_of_set(scene, rays):
    name = f"traversal, {scene['name']}, {rays['name']}"
    least = LEAST_ON_LANDSCAPE.get(rays["name"], 1.0) if scene["name"] == "landscape" else 1.0
    mistakes = rays["mismatches"]
    yield check(f"{name}: rate over Embree's best call", rays["default"]["ratio"], least=least,
                note=rays["default"]["best"])
    yield check(f"{name}: rate over Embree's best robust call", rays["robust"]["ratio"],
                least=LEAST_AGAINST_ROBUST, note=rays["robust"]["best"])
    yield check(f"{name}: answers that differ and are no ties", mistakes["ours_wrong"], most=0,
                note=f"{mistakes['ties']} ties, Embree wrong in {mistakes['theirs_wrong']} of {rays['rays']}")


def _ours(rays):
    return next(t["mrays_per_second"] for t in rays["tracers"] if t["name"] == "Parhelion")


def _checks_of_threads(one, two):
    for a, b in zip(one["scenes"], two["scenes"]):
        for x, y in zip(a["sets"], b["sets"]):
            yield check(f"traversal, {a['name']}, {x['name']}: rays of 2 threads over 1", _ours(y) / _ours(x),
                        least=LEAST_OF_TWO_THREADS)


def build(context):
    runs = [_run_native(context, "build", threads) for threads in thread_counts()]
    for r in runs:
        sizes = r["sizes"]
        for key in ("seconds", "embree_seconds"):
            r[f"{key}_exponent"] = fits.power_fit([s["triangles"] for s in sizes], [s[key] for s in sizes])[0]
    threads, sizes = runs[-1]["threads"], runs[-1]["sizes"]
    checks = [check(f"build, {s['triangles']} triangles, {threads} thread(s): seconds over Embree's", s["ratio"],
                    most=1.2) for s in sizes if s["triangles"] > 50_000]
    checks.append(check("build: bytes a triangle, nodes and leaves, worst size",
                        max(s["bytes_per_triangle"] for s in sizes), most=80))
    return {"runs": runs}, checks
