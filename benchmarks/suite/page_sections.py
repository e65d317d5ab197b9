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
