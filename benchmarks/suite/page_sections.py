"""What the page shows of each subcommand's result: one function a subcommand, giving HTML."""
from . import svg


def traversal(result, table, plots):
    parts = []
    for run in result["runs"]:
        for scene in run["scenes"]:
            parts.append(f"<h3>{scene['name']}, {scene['triangles']} triangles, {run['threads']} thread(s)</h3>")
            names = []
            for rays in scene["sets"]:
                names += [t["name"] for t in rays["tracers"] if t["name"] not in names]
            rows = []
            for name in names:
                rates = [next((t["mrays_per_second"] for t in rays["tracers"] if t["name"] == name), None)
                         for rays in scene["sets"]]
                rows.append((name, *rates))
            parts.append(table(["Mrays/s", *(rays["name"] for rays in scene["sets"])], rows))
            parts.append(plots([svg.bars(
                f"{scene['name']}, {run['threads']} thread(s): rate over Embree's best call", "ratio",
                [(rays["name"], [rays["default"]["ratio"], rays["robust"]["ratio"]]) for rays in scene["sets"]],
                ["default mode", "robust mode"], line=1)]))
    return "\n".join(parts)


def build(result, table, plots):
    parts, drawings = [], []
    for run in result["runs"]:
        columns = ["triangles", "seconds", "embree_seconds", "ratio", "sah_cost", "bytes_per_triangle",
                   "embree_bytes_per_triangle", "triangles_per_second"]
        parts.append(f"<h3>{run['threads']} thread(s)</h3><p>Seconds grow as triangles to the power "
                     f"{run['seconds_exponent']:.3f}, Embree's {run['embree_seconds_exponent']:.3f}.</p>")
        parts.append(table([c.replace("_", " ") for c in columns], [[s[c] for c in columns] for s in run["sizes"]]))
        drawings.append(svg.lines(
            f"build, {run['threads']} thread(s)", "triangles", "seconds",
            [(name, [(s["triangles"], s[key]) for s in run["sizes"]])
             for name, key in (("Parhelion", "seconds"), ("Embree", "embree_seconds"))], legend_right=False))
    return "\n".join(parts) + plots(drawings)


def render(result, table, plots):
    stages = list(result["scenes"][0]["share"])
    parts = [table(["scene", "Mpaths/s", "Mrays/s", "vertices a path", "pool B a path",
                    *(f"{s} %" for s in stages), *(f"{s} ns" for s in stages)],
                   [(r["name"], r["mpaths_per_second"], r["mrays_per_second"], r["vertices_per_path"],
                     r["pool_bytes_per_path"], *(100 * r["share"][s] for s in stages), *(r["ns"][s] for s in stages))
                    for r in result["scenes"]]),
             "<p>ns: of generate and accumulate a path, of intersect and shade a vertex, of shadow a shadow ray.</p>",
             table(["what shading a vertex takes more with", "ns", "ns without"],
                   [(r["name"], r["ns"], r["shade_ns"]) for r in result["lookups"]])]
    drawings = [svg.bars("share of each stage", "share", [(r["name"], [r["share"][s] for s in stages])
                                                          for r in result["scenes"][:5]], stages)]
    for key, x, label in (("resolution", "size", "pixels a side"), ("triangles", "primitives", "triangles"),
                          ("emitters", "lamps", "lamps")):
        rows = result[key]
        parts.append(table([label, "render seconds", "Mpaths/s", "Mrays/s", "pool bytes", "scene bytes", "host peak MB"],
                           [(r[x], r["seconds"], r["mpaths_per_second"], r["mrays_per_second"], r["pool_bytes"],
                             r["scene_bytes"], r["host_peak_bytes"] / 1e6) for r in rows]))
        drawings.append(svg.lines(f"growth with {label}", label, "render seconds",
                                  [("seconds", [(r[x], r["seconds"]) for r in rows])], legend_right=False))
    parts.append(table(["max_depth", "seconds", "vertices a path", "Mpaths/s", "Mrays/s"],
                       [(r["max_depth"], r["seconds"], r["vertices_per_path"], r["mpaths_per_second"],
                         r["mrays_per_second"]) for r in result["depth"]]))
    drawings.append(svg.lines("growth with depth", "vertices a path", "render seconds",
                              [("seconds", [(r["vertices_per_path"], r["seconds"]) for r in result["depth"]])],
                              log_x=False, log_y=False, legend_right=False))
    return "\n".join(parts) + plots(drawings)


def compile(result, table, plots):  # named as the subcommand
    steps = ["load", "bvh", "compile", "upload", "render", "write"]
    rows = [(f"{s['name']}, {kind}", s[kind]["process_seconds"], s[kind]["peak_bytes"] / 1e6,
             s[kind]["compiler_peak_bytes"] / 1e6, *(s[kind][step] for step in steps))
            for s in result["scenes"] for kind in ("cold", "warm")]
    drawing = svg.bars("seconds to a 1-spp image", "seconds",
                       [(s["name"], [s["cold"]["process_seconds"], s["warm"]["process_seconds"]])
                        for s in result["scenes"]], ["cold", "warm"])
    return table(["start", "whole process s", "peak MB", "second process MB", *(f"{s} s" for s in steps)], rows) + plots([drawing])


def time_to_error(result, table, plots):
    parts = [f"<p>{result['threads']} thread(s) each. Beside us: {', '.join(result['peers']) or 'none'}.</p>"]
    if result["skipped"]:
        parts.append("<ul>" + "".join(f"<li>{reason}</li>" for reason in result["skipped"]) + "</ul>")
    for scene in result["scenes"]:
        parts.append(_error_scene(scene, table, plots))
    return "\n".join(parts)


def _error_scene(scene, table, plots):
    against = (f"a reference of {scene['reference_spp']} spp, own RMSE below {scene['reference_rmse']:.2g}, taken off"
               if scene["reference_spp"] else "the known answer")
    curves = scene["curves"]
    rows = [(c["name"], p["spp"], p["runs"], p["seconds"], p["process_seconds"], p["rmse"], p.get("relmse"),
             p.get("flip"), p.get("efficiency")) for c in curves for p in c["points"]]
    fitted = [(c["name"], c["exponent_of_spp"], c["fit"]["bias"], c["fit"]["bias_low"], c["fit"]["bias_high"],
               (c["paths_per_second"] or 0) / 1e6) for c in curves if c.get("fit")]
    faster = [(s["name"], *(f"{row['speed_up']:.2f}{' *' if row['extrapolated'] else ''}" if row["speed_up"] else None
                           for row in s["levels"]))
              for s in scene["speed_up"]]
    drawings = [svg.lines(f"{scene['name']}: RMSE", "seconds rendering", "RMSE",
                          [(c["name"], [(p["seconds"], p["rmse"]) for p in c["points"]]) for c in curves]),
                svg.lines(f"{scene['name']}: RMSE, whole process", "seconds from start to file", "RMSE",
                          [(c["name"], [(p["process_seconds"] or 0, p["rmse"]) for p in c["points"]])
                           for c in curves]),
                *(svg.lines(f"{scene['name']}: {name}", "seconds rendering", name,
                            [(c["name"], [(p["seconds"], p.get(key) or 0) for p in c["points"]]) for c in curves])
                  for key, name in (("relmse", "relMSE"), ("flip", "FLIP")))]
    return "\n".join([
        f"<h3>{scene['name']}</h3><p>Errors against {against}.</p>",
        table(["faster than", *(f"to RMSE {level:.3g}" for level in scene["levels"])], faster),
        table(["fit", "exponent of spp", "bias", "from", "to", "Mpaths/s"], fitted), plots(drawings),
        "<details><summary>All points</summary>",
        table(["", "spp", "runs", "seconds", "whole process s", "RMSE", "relMSE", "FLIP", "1/(MSE s)"], rows),
        "</details>"])


def gallery(result, table, plots):
    size, head = result["size"], ["scene", "seconds", "RMSE", "relMSE", "FLIP", "mean", "seconds of the reference"]
    parts = [f"<p>{size}x{size} pixels: {result['spp']} samples a pixel, a reference of {result['reference_spp']} with other "
             "seeds, the absolute difference, and FLIP (white where it is 1).</p>",
             table(head, [(r["name"], r["seconds"], r["rmse"], r["relmse"], r["flip"], r["mean"], r["reference_seconds"])
                          for r in result["scenes"]])]
    for row in result["scenes"]:
        images = "".join(f'<figure><img src="{uri}" alt="{row["name"]}: {title}"><figcaption>{title}</figcaption></figure>'
                         for title, uri in row["pictures"])
        parts.append(f'<h3>{row["name"]}</h3><div class="plots">{images}</div>')
    return "\n".join(parts)
