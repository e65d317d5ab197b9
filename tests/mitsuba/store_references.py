"""Writes references.json: what Mitsuba 3 says of the cases of cases.json, region by region.

Needs what compare.py needs. The test suite reads the file and needs neither Mitsuba nor Python:
    python tests/mitsuba/store_references.py --cache /tmp/mitsuba-references [NAME...]
Also what Mitsuba's tables say: its conductors' indices, the CIE's observer and illuminant D65.
Of each case and channel: the mean of the picture, then of its GRID x GRID regions row by row (top
left first), each with its standard error, from SEEDS independent renders. Cases in which Mitsuba is wrong
are left out, and channels that we do not have. With names, only those cases are made again.
"""

import argparse
import json
import pathlib
import re

import mitsuba
import numpy as np

import reference

HERE = pathlib.Path(__file__).resolve().parent
FILE = HERE / "references.json"
SEEDS = list(range(1, 17))
GRID = 4
NOTHING = 1e-12
SAMPLES = 2048  # a pixel, of all renders together


def regions(image):
    """Means of the picture and of its regions, borders at floor(k * side / GRID)."""
    height, width = image.shape
    rows = [k * height // GRID for k in range(GRID + 1)]
    columns = [k * width // GRID for k in range(GRID + 1)]
    means = [image.mean()]
    for top, bottom in zip(rows, rows[1:]):
        for left, right in zip(columns, columns[1:]):
            means.append(image[top:bottom, left:right].mean())
    return np.array(means)


def figures(stack):
    """[[mean, standard error] of the picture and each region] of a stack (S, H, W)."""
    means = np.stack([regions(image) for image in stack])
    errors = means.std(0, ddof=1) / np.sqrt(len(stack))
    means = means.mean(0)
    means[np.abs(means) < NOTHING] = 0  # what is left of a cosine of a right angle
    return [[float(f"{m:.7g}"), float(f"{e:.3g}")] for m, e in zip(means, errors)]


def stored(case, cache):
    stacks, seconds = reference.render(case, HERE, SAMPLES, SEEDS, cache)
    height, width = next(iter(stacks.values())).shape[1:]
    print(f"{case['name']}: {width} x {height}, {seconds:.0f} s", flush=True)
    without = case.get("without")
    channels = {
        name: figures(stack)
        for name, stack in sorted(stacks.items())
        if not (without and name.startswith(without))
    }
    return {"size": [width, height], "channels": channels}


def conductors():
    """name -> eta, then k, as linear sRGB."""
    presets = HERE / "../../host/scene/mitsuba/conductor_presets.inl"
    names = re.findall(r'^\{"([^"]+)"', presets.read_text(), re.MULTILINE)
    found = {}
    for name in names:
        values = mitsuba.traverse(mitsuba.load_dict({"type": "conductor", "material": name}))
        found[name] = [
            float(f"{v:.9g}")
            for key in ("eta", "k")
            for v in np.broadcast_to(np.array(values[f"{key}.value"]).ravel(), 3)
        ]
    return found


def observer():
    """x, y, z and D65 every 5 nm from 360 to 830 nm."""
    table = [
        [*np.array(mitsuba.cie1931_xyz(nm)).ravel(), float(mitsuba.cie_d65(nm))]
        for nm in range(360, 831, 5)
    ]
    return [[float(f"{v:.9g}") for v in row] for row in table]


def rows(values):
    """One line an entry, of a list or of a dict."""
    if isinstance(values, dict):
        return ",\n".join(f"{json.dumps(k)}: {json.dumps(v)}" for k, v in values.items())
    return ",\n".join(json.dumps(v) for v in values)


def write(kept):
    """One line a channel."""
    lines = []
    for name, case in kept.items():
        channels = [f'  "{c}": {json.dumps(v)}' for c, v in case["channels"].items()]
        body = ",\n".join(channels)
        lines.append(f'"{name}": {{"size": {case["size"]}, "channels": {{\n{body}}}}}')
    about = {
        "mitsuba": mitsuba.__version__,
        "samples": SAMPLES,
        "renders": len(SEEDS),
        "grid": GRID,
    }
    tables = [f'"observer": [\n{rows(observer())}\n]']
    tables += [f'"conductors": {{\n{rows(conductors())}\n}}']
    text, table_text = ",\n".join(lines), ",\n".join(tables)
    FILE.write_text(
        f'{{"about": {json.dumps(about)},\n{table_text},\n"cases": {{\n{text}\n}}}}\n'
    )


def main():
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("--cache", help="folder that keeps Mitsuba's renders")
    parser.add_argument("names", nargs="*", help="of cases; default all")
    args = parser.parse_args()
    cases = json.loads((HERE / "cases.json").read_text())["cases"]
    old = json.loads(FILE.read_text())["cases"] if FILE.exists() else {}
    kept = {}
    for case in cases:
        name = case["name"]
        if case.get("mitsuba_is_wrong"):
            continue
        again = not args.names or name in args.names
        if again or name in old:
            kept[name] = stored(case, args.cache) if again else old[name]
    write(kept)


if __name__ == "__main__":
    main()
