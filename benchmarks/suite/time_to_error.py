"""time-to-error: seconds against error, for us and for every other renderer found here."""
import math

from . import error_cases, fits
from .context import Failure, check, say
from .error_fit import mean_square_fit
from .peers.found import found
from .renderer import compare, render

# spp: number of independent runs
PLAN = {1: 16, 4: 6, 16: 4, 64: 4, 256: 2, 1024: 1, 4096: 1}
PEER_PLAN = {1: 3, 4: 3, 16: 3, 64: 2, 256: 1, 1024: 1, 4096: 1}
QUICK_PLAN, QUICK_PEER_PLAN = {1: 6, 16: 2, 64: 2}, {4: 1, 16: 1, 64: 1}
# Seconds of rendering for one renderer and scene; a job that would not fit is left out.
BUDGET, QUICK_BUDGET, CLOSED_FORM_SHARE = 10.0, 1.5, 0.3

MODELS_DIFFER = 0.01  # of the mean: a path's last vertex, spheres of triangles

PBRT_NAME = "pbrt-v4 (figures of another day)"


def time_to_error(context):
    peers, absent = found(context)
    cases, missing = error_cases.cases(context)
    absent += missing
    for reason in absent:
        say(reason)
    result = {"threads": context.threads, "skipped": absent, "peers": [f"{p.name} {p.version}" for p in peers],
              "scenes": []}
    checks = []
    for case in cases:
        say(case.name)
        scene = measure_case(context, case, peers)
        result["scenes"].append(scene)
        result["skipped"] += scene.pop("skipped")
        checks += [*_checks_of_sampling(scene), *_checks_of_speed(scene, case.least)]
    checks += _checks_of_rates(result["scenes"])
    return result, checks


def measure_case(context, case, peers):
    reference = error_cases.reference(context, case)
    curves, skipped = [_ours(context, case, reference)], []
    for peer in peers:
        say(f"{case.name}: {peer.name}")
        try:
            curves.append(_same_picture(_peers(context, case, reference, peer), curves[0], case))
        except Failure as e:
            say(f"skipped: {e}")
            skipped.append(f"{case.name}, {peer.name}: {e}")
    own = _reference_mean_square(curves[0], reference)
    for curve in curves:
        _finish(curve, own)
    if case.pbrt and context.threads == 1:
        points = [{"spp": n, "runs": 1, "seconds": t, "process_seconds": None, "rmse": e}
                  for n, t, e in error_cases.PBRT[case.pbrt]]
        curves.append({"name": PBRT_NAME, "points": points})
    mean = curves[0]["mean"]
    levels = [level * mean if case.relative_levels else level for level in case.levels]
    return {"name": case.name, "reference_spp": reference["spp"], "reference_rmse": math.sqrt(own), "mean": mean,
            "levels": levels, "curves": curves, "speed_up": [_speed_up(curves[0], c, levels) for c in curves[1:]],
            "skipped": skipped}


def _budget(context, case):
    return (QUICK_BUDGET if context.quick else BUDGET) * (CLOSED_FORM_SHARE if case.truth else 1)


def _ours(context, case, reference):
    plan = QUICK_PLAN if context.quick else PLAN
    render(context, case.scene, spp=1, size=case.size)  # compiles
    runs, left, rate = [], _budget(context, case), 0.0
    for spp, count in plan.items():
        for k in range(count):
            if runs and rate * spp > left:
                continue
            stats = render(context, case.scene, spp=spp, size=case.size, threads=context.threads, seed=1000 * spp + k)
            runs.append({"spp": spp, "seconds": stats["time"]["render_seconds"],
                         "process_seconds": stats["process_seconds"],
                         "pixels": case.size**2,
                         **compare(context, stats["image"], reference["image"])})
            left -= runs[-1]["seconds"]
            rate = runs[-1]["seconds"] / spp
    return _curve("Parhelion", runs)


def _peers(context, case, reference, peer):
    plan = QUICK_PEER_PLAN if context.quick else PEER_PLAN
    jobs = [{"spp": spp, "seed": 7 + 1000 * spp + k, "output": context.scratch / f"peer-{spp}-{k}.exr"}
            for spp, count in plan.items() if spp <= peer.most_spp for k in range(count)]
    runs = peer.render(case.scene, case.size, context.threads, jobs, _budget(context, case))
    return _curve(peer.name, [{"spp": r["spp"], "seconds": r["seconds"], "process_seconds": r["process_seconds"],
                               "pixels": case.size**2, **compare(context, r["output"], reference["image"])}
                              for r in runs])


def _same_picture(curve, ours, case):
    """The curve, unless its picture is another one: a mean off by more than models differ and noise explains."""
    noise = 4 * curve["points"][-1]["measured_rmse"] / case.size
    off = curve["mean"] - ours["mean"]
    if abs(off) > MODELS_DIFFER * ours["mean"] + noise:
        raise Failure(f"its mean is off by {100 * off / ours['mean']:+.1f} %: not the same picture")
    return curve


def _curve(name, runs):
    """Independent runs of the same samples become one point: middle of the times, root mean square of the errors."""
    points = []
    for spp in sorted({r["spp"] for r in runs}):
        same = [r for r in runs if r["spp"] == spp]
        points.append({"spp": spp, "runs": len(same), "seconds": fits.median([r["seconds"] for r in same]),
                       "process_seconds": fits.median([r["process_seconds"] for r in same]),
                       "rmse_each": [r["rmse"] for r in same],
                       "measured_rmse": fits.root_mean_square([r["rmse"] for r in same]),
                       "relmse": sum(r["relmse"] for r in same) / len(same),
                       "flip": sum(r["flip"] for r in same) / len(same)})
    last = points[-1]
    rate = runs[-1]["pixels"] * last["spp"] / last["seconds"]
    return {"name": name, "points": points, "mean": runs[-1]["mean"], "paths_per_second": rate}


def _reference_mean_square(ours, reference):
    """The reference's own error: our last point's, continued as our points fall, at least as independent samples do."""
    points = ours["points"]
    if not reference["spp"] or len(points) < 2:
        return 0.0
    exponent, _ = fits.power_fit([p["spp"] for p in points], [p["measured_rmse"] for p in points])
    share = (points[-1]["spp"] / reference["spp"]) ** max(1.0, -2 * exponent)
    return points[-1]["measured_rmse"] ** 2 * share / (1 + share)


def _finish(curve, reference_mean_square):
    """Takes the reference's own error off, then fits."""
    for p in curve["points"]:
        p["rmse"] = math.sqrt(max(p["measured_rmse"] ** 2 - reference_mean_square, 1e-16))
        p["efficiency"] = 1 / (p["rmse"] ** 2 * p["seconds"])
    spps, errors = [p["spp"] for p in curve["points"]], [p["rmse"] for p in curve["points"]]
    curve["exponent_of_spp"] = fits.power_fit(spps, errors)[0] if len(spps) > 1 else None
    curve["fit"] = mean_square_fit([(p["seconds"], p["rmse"] ** 2, p["runs"]) for p in curve["points"]])


def _seconds_at(curve, level):
    return fits.time_at([(p["seconds"], p["rmse"]) for p in curve["points"]], level)


def _speed_up(ours, other, levels):
    ranges = [[p["rmse"] for p in c["points"]] for c in (ours, other)]
    rows = []
    for level in levels:
        a, b = _seconds_at(ours, level), _seconds_at(other, level)
        outside = any(not min(r) <= level <= max(r) for r in ranges)
        rows.append({"rmse": level, "seconds": a, "other_seconds": b, "speed_up": b / a if a and b else None,
                     "extrapolated": outside})
    return {"name": other["name"], "levels": rows}


def _checks_of_speed(scene, least):
    """How many times as fast to an equal error; than LuxCore and others: ahead."""
    wanted = {"Cycles": least, "Mitsuba llvm_ad_rgb": least, PBRT_NAME: 15}
    for other in scene["speed_up"]:
        rows = [row for row in other["levels"] if row["speed_up"]]
        if not rows:
            continue  # its error does not fall here, or ours is none: see the curves
        note = ", ".join(f"{row['speed_up']:.2f} at {row['rmse']:.3g}{' (extrapolated)' if row['extrapolated'] else ''}"
                         for row in rows)
        yield check(f"time to error, {scene['name']}: seconds of {other['name']} over ours, worst of three levels",
                    min(row["speed_up"] for row in rows), least=wanted.get(other["name"], 1), note=note)


def _checks_of_sampling(scene):
    """One sample a pixel is as good as independent sampling gets: 64 independent ones would be 8 times better."""
    points = {p["spp"]: p for p in scene["curves"][0]["points"]}
    if not {1, 64} <= points.keys() or min(points[1]["runs"], points[64]["runs"]) < 4:
        return
    one, many = points[1], points[64]
    ratio = 8 * many["rmse"] / one["rmse"]
    error = 2 * ratio * math.hypot(*(fits.standard_error(p["rmse_each"]) / p["measured_rmse"] for p in (one, many)))
    yield check(f"samples, {scene['name']}: RMSE at 64 spp over independent sampling's, less 2 standard errors",
                max(0.0, ratio - error), most=0.75 if scene["name"] == "Cornell box" else 1.0,
                note=f"{ratio:.4f} +- {error:.4f}")


def _checks_of_rates(scenes):
    cornell = next((s for s in scenes if s["name"] == "Cornell box"), None)
    rates = {c["name"]: c.get("paths_per_second") for c in cornell["curves"]} if cornell else {}
    if rates.get("Cycles"):
        yield check("Cornell box, 8 bounces: our paths a second over Cycles'", rates["Parhelion"] / rates["Cycles"],
                    least=5, note=f"{rates['Parhelion'] / 1e6:.2f} and {rates['Cycles'] / 1e6:.2f} Mpaths/s")
