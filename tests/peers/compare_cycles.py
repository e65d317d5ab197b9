#!/usr/bin/env python3
"""Our images beside Cycles' references, pixel by pixel.

Usage: compare_cycles.py PROGRAM REFERENCES [--spp N]
REFERENCES is a folder of cycles_seed<S>_<scene>_<N>spp.exr, four seeds a scene, 128x128.

For each scene: the difference of the means, and the RMSE between our image and theirs beside the RMSE
between two of their own seeds, which is what noise alone gives. Then the Cornell box again with shorter
paths, since Cycles ends a path earlier than we do.
"""
import argparse
import itertools
import json
import math
import pathlib
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[2]
SCENES = {
    "cornell": "cornell-box/scene.xml",
    "spheres": "glass-and-metal/scene.xml",
    "bunny_env": "bunny/env.xml",
    "bunny_point": "bunny/point.xml",
}


def render(program, scene, out, spp, *options):
    subprocess.run(
        [program, "render", ROOT / "scenes" / scene, "-o", out, "--force", "--quiet", "--allow-outside", "--no-energy-compensation",
         "--shading-normals", "raw",
         "--size", "128x128", "--spp", str(spp), *options], check=True)


def compare(program, a, b):
    run = subprocess.run([program, "compare", a, b, "--json", "--common"], capture_output=True, text=True)
    if run.returncode > 1:
        sys.exit(run.stderr)
    return json.loads(run.stdout)


def root_mean_square(values):
    return math.sqrt(sum(v * v for v in values) / len(values))


def mean_difference(reports):
    """Relative difference of the means of R, G, B over all references, in percent."""
    channels = zip(*(report["channels"] for report in reports))
    return [100 * (sum(c["mean_image"] for c in same) / sum(c["mean_reference"] for c in same) - 1)
            for same in channels]


def percent(values):
    return " / ".join(f"{v:+.3f}" for v in values) + " %"


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program")
    parser.add_argument("references", type=pathlib.Path)
    parser.add_argument("--spp", type=int, default=1024)
    arguments = parser.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        ours = pathlib.Path(folder) / "ours.exr"
        for name, scene in SCENES.items():
            references = sorted(arguments.references.glob(f"cycles_seed*_{name}_1024spp.exr"))
            render(arguments.program, scene, ours, arguments.spp)
            against = [compare(arguments.program, ours, r) for r in references]
            among = [compare(arguments.program, a, b) for a, b in itertools.combinations(references, 2)]
            worst = max((r["max_error"] for r in against), key=lambda l: l["value"])
            print(f"{name:12} means {percent(mean_difference(against))}"
                  f"   RMSE {root_mean_square([r['all']['rmse'] for r in against]):.5f},"
                  f" between their seeds {root_mean_square([r['all']['rmse'] for r in among]):.5f}"
                  f"   FLIP {sum(r['flip']['mean'] for r in against) / len(against):.4f}"
                  f"   largest {worst['value']:.3f} at ({worst['x_px']}, {worst['y_px']})", flush=True)
        references = sorted(arguments.references.glob("cycles_seed*_cornell_1024spp.exr"))
        for vertices in (7, 8, 9):
            render(arguments.program, SCENES["cornell"], ours, arguments.spp, "--max-depth", str(vertices + 1))
            print(f"cornell with {vertices} vertices: means"
                  f" {percent(mean_difference([compare(arguments.program, ours, r) for r in references]))}", flush=True)


if __name__ == "__main__":
    main()
