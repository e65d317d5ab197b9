"""Compares Parhelion with Mitsuba 3 on the scenes of cases.json: pixels, tiles and the mean.

Needs Python 3.9 or newer with `pip install mitsuba numpy`. Not part of the test suite. Examples:
    python tests/mitsuba/compare.py --parhelion ./parhelion --cache /tmp/mitsuba-references
    python tests/mitsuba/compare.py --parhelion ./parhelion --scenes shapes --images /tmp/out
    python tests/mitsuba/compare.py --parhelion ./parhelion --scene my.xml -D width=64 --spp 512
    python tests/mitsuba/compare.py --self-test --cache /tmp/mitsuba-references
Exit code 0: all agree, 1: some differ, 2: something could not be rendered.
"""

import argparse
import json
import pathlib
import subprocess
import sys
import tempfile
import time

import mitsuba
import numpy as np

import reference
import ztest

HERE = pathlib.Path(__file__).resolve().parent
REFERENCE_SEEDS = list(range(1, 17))
SELF_SEEDS = list(range(1001, 1009))


def parhelion_render(program, case, spp, seeds, extra):
    """Renders the case with Parhelion; spp is split over the seeds.

    Returns (dict channel -> (S, H, W), seconds).
    """
    begin, images = time.monotonic(), []
    with tempfile.TemporaryDirectory() as folder:
        for seed in seeds:
            out = pathlib.Path(folder) / f"{seed}.exr"
            command = [
                program,
                "render",
                str(HERE / case["scene"]),
                "-o",
                str(out),
                "--spp",
                str(max(1, spp // len(seeds))),
                "--seed",
                str(seed),
                # The tests' smallest believed variance is that of one independent sample.
                "--sampler",
                "independent",
                "--filter-by",
                "sampling",
                # Mitsuba takes interpolated normals as they are, and lobes of single scattering.
                "--shading-normals",
                "raw",
                "--no-energy-compensation",
                "--force",
                "--quiet",
            ]
            for name, value in case.get("parameters", {}).items():
                command += ["-D", f"{name}={value}"]
            run = subprocess.run(command + extra, capture_output=True, text=True, check=False)
            if run.returncode != 0:
                raise RuntimeError(
                    f"exit code {run.returncode}: {(run.stderr or run.stdout).strip()}"
                )
            images.append(reference.read_exr(out))
    stacks = {name: np.stack([image[name] for image in images]) for name in images[0]}
    return stacks, time.monotonic() - begin


def write_pictures(folder, name, first, second):
    """Reference, image and difference (grey: equal; black, white: 8 standard errors) as PNG."""
    wanted = [c for c in ("R", "G", "B") if c in first and c in second] or [
        c for c in ("Y", "X", "Z") if c in first and c in second
    ][:1]
    if not wanted or first[wanted[0]].shape[1:] != second[wanted[0]].shape[1:]:
        return
    folder = pathlib.Path(folder)
    folder.mkdir(parents=True, exist_ok=True)
    planes = [ztest.welch(first[c], second[c]) for c in wanted]
    difference = np.stack(
        [0.5 + np.where(e > 0, d / np.where(e > 0, e, 1), 0) / 16 for d, e, _ in planes], -1
    )
    pictures = {
        "mitsuba": np.stack([first[c].mean(0) for c in wanted], -1),
        "parhelion": np.stack([second[c].mean(0) for c in wanted], -1),
    }
    for label, pixels in pictures.items():
        save_png(folder / f"{name}-{label}.png", np.clip(pixels, 0, 1) ** (1 / 2.2))
    save_png(folder / f"{name}-difference.png", np.clip(difference, 0, 1))


def save_png(path, pixels):
    if pixels.shape[2] == 1:
        pixels = np.repeat(pixels, 3, 2)
    pixels = np.repeat(np.repeat(pixels, 4, 0), 4, 1)
    mitsuba.Bitmap((pixels * 255 + 0.5).astype(np.uint8)).write(str(path))


def print_result(name, result, seconds):
    verdict = "agrees " if all(c["pass"] for c in result.values()) else "DIFFERS"
    print(f"{verdict} {name}  ({seconds[0]:.0f} s Mitsuba, {seconds[1]:.0f} s image)")
    for channel, c in result.items():
        if "p_of_mean" not in c:
            print(f"    {channel:>8}: {json.dumps({k: v for k, v in c.items() if k != 'pass'})}")
            continue
        mark = " " if c["pass"] else "!"
        print(
            f"  {mark} {channel:>8}: mean {c['image_mean']:.6g} against {c['reference_mean']:.6g}, "
            f"{100 * c['relative_difference_of_means']:+.4f} % "
            f"+-{100 * c['its_95_percent_half_interval']:.4f} "
            f"(p {c['p_of_mean']:.3g}); pixels {c['pixels_failing']}/{c['pixels']}, "
            f"tiles {c['tiles_failing']}/{c['tiles']} failing; rms z {c['rms_z']:.3f}; "
            f"worst ({c['worst_pixel']['x']},{c['worst_pixel']['y']}) "
            f"{c['worst_pixel']['image']:.6g} "
            f"against {c['worst_pixel']['reference']:.6g}"
        )
    sys.stdout.flush()


def print_truth(case, result):
    """For cases whose mean is known otherwise: how far both renderers are from it."""
    for channel, truth in case.get("truth", {}).items():
        c = result[channel]
        print(
            f"    {channel:>8}: truth {truth:.6g}: "
            f"image {100 * (c['image_mean'] / truth - 1):+.4f} %, "
            f"Mitsuba {100 * (c['reference_mean'] / truth - 1):+.4f} %",
            flush=True,
        )


def self_test(case, spp, args):
    """Mitsuba must agree with itself in other seeds, but not with the case's deliberate mistake."""
    first, _ = reference.render(case, HERE, spp, REFERENCE_SEEDS, args.cache)
    second, seconds = reference.render(case, HERE, spp, SELF_SEEDS, args.cache)
    result = ztest.compare_images(first, second, (spp, spp))
    print_result(case["name"], result, (0, seconds))
    good = all(c["pass"] for c in result.values())
    if "wrong" in case:
        parameters = dict(case.get("parameters", {}), **case["wrong"])
        wrong = dict(case, name=case["name"] + "_wrong", parameters=parameters)
        third, _ = reference.render(wrong, HERE, spp, SELF_SEEDS, args.cache)
        found = not all(c["pass"] for c in ztest.compare_images(first, third, (spp, spp)).values())
        print(f"    deliberate mistake {case['wrong']}: {'found' if found else 'NOT FOUND'}")
        good = good and found
    return good, result


def compare(case, spp, args):
    first, a = reference.render(case, HERE, spp, REFERENCE_SEEDS, args.cache)
    second, b = parhelion_render(
        args.parhelion, case, args.image_spp or spp, range(1, args.seeds + 1), args.extra
    )
    result = ztest.compare_images(first, second, (spp, args.image_spp or spp))
    if args.images:
        write_pictures(args.images, case["name"], first, second)
    print_result(case["name"], result, (a, b))
    print_truth(case, result)
    agrees = all(c["pass"] for c in result.values())
    if not agrees and "explained" in case:
        print(f"    explained: {case['explained']}", flush=True)
    return agrees or "explained" in case, result


def arguments():
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("--parhelion", help="the program to test")
    parser.add_argument(
        "--scenes", nargs="*", help="names of cases, or beginnings of names; default all"
    )
    parser.add_argument("--scene", help="one scene file instead of the list (with --spp)")
    parser.add_argument(
        "-D", action="append", default=[], metavar="NAME=VALUE", help="parameter of --scene"
    )
    parser.add_argument(
        "--spp", type=int, help="samples a pixel in all, instead of each case's own"
    )
    parser.add_argument(
        "--image-spp", type=int, help="samples a pixel in all for Parhelion (default as Mitsuba)"
    )
    parser.add_argument("--seeds", type=int, default=8, help="independent renders with Parhelion")
    parser.add_argument("--cache", help="folder that keeps Mitsuba's renders")
    parser.add_argument("--images", help="folder for PNGs of both and of the difference")
    parser.add_argument("--json", help="file for all figures")
    parser.add_argument("--self-test", action="store_true", help="Mitsuba against itself")
    parser.add_argument("--references-only", action="store_true", help="only fill the cache")
    parser.add_argument("extra", nargs="*", help="after --: more arguments for parhelion render")
    return parser.parse_args()


def main():
    args = arguments()
    if not (args.parhelion or args.self_test or args.references_only):
        sys.exit("one of --parhelion, --self-test and --references-only is needed")
    cases = json.loads((HERE / "cases.json").read_text())["cases"]
    if args.scene:
        cases = [
            {
                "name": pathlib.Path(args.scene).parent.name + "_" + pathlib.Path(args.scene).stem,
                "scene": str(pathlib.Path(args.scene).resolve()),
                "spp": 1024,
                "parameters": dict(d.split("=", 1) for d in args.D),
            }
        ]
    elif args.scenes:
        cases = [c for c in cases if any(c["name"].startswith(s) for s in args.scenes)]
    report, differing, broken = {}, [], []
    for case in cases:
        spp = args.spp or case["spp"]
        try:
            if args.references_only:
                _, seconds = reference.render(case, HERE, spp, REFERENCE_SEEDS, args.cache)
                print(f"{case['name']}: {seconds:.1f} s", flush=True)
                continue
            good, report[case["name"]] = (self_test if args.self_test else compare)(case, spp, args)
            differing += [] if good else [case["name"]]
        except RuntimeError as error:
            broken.append(case["name"])
            report[case["name"]] = {"error": str(error)}
            print(f"FAILED  {case['name']}: {error}", flush=True)
    if args.json:
        pathlib.Path(args.json).write_text(json.dumps(report, indent=1) + "\n")
    print(f"{len(cases)} cases, {len(differing)} differ, {len(broken)} could not be rendered")
    print(
        "\n".join(
            ["differ: " + " ".join(differing)] * bool(differing)
            + ["could not be rendered: " + " ".join(broken)] * bool(broken)
        )
    )
    return 2 if broken else 1 if differing else 0


if __name__ == "__main__":
    sys.exit(main())
