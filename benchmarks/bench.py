#!/usr/bin/env python3
"""Measures Parhelion, beside others where they are found, and says which targets hold.

traversal      rays a second on five sets of rays, beside every call of Embree's
build          seconds to build a tree, beside Embree's commit, from 10 k to 10 M triangles
render         paths and rays a second, the stages' shares, growth with pixels, depth, triangles, emitters
compile        seconds to the first image, with empty caches and with full ones; the compiler's memory
time-to-error  seconds to a given error, beside Mitsuba 3, Cycles and LuxCore
gallery        pictures, references, differences, FLIP and times on one page
all            all of these
"""
import argparse
import json
import os
import pathlib
import sys
import tempfile

sys.dont_write_bytecode = True
from suite import first_image, gallery, machine, native, page, render_rates, time_to_error  # noqa: E402
from suite.context import Context, Failure, say  # noqa: E402

SUBCOMMANDS = {
    "traversal": native.traversal,
    "build": native.build,
    "render": render_rates.rates,
    "time-to-error": time_to_error.time_to_error,
    "compile": first_image.first_image,
    "gallery": gallery.gallery,
}
ROOT = pathlib.Path(__file__).resolve().parents[1]
WORK = ROOT / "build" / "bench"


class Parser(argparse.ArgumentParser):
    def error(self, message):
        self.exit(2, f"parhelion bench: {message}\n")


def positive(text):
    value = int(text)
    if value < 1:
        raise argparse.ArgumentTypeError(f"{text} is not positive")
    return value


def arguments():
    parser = Parser(prog="parhelion bench", description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("subcommand", nargs="?", default="all", choices=[*SUBCOMMANDS, "all"], metavar="SUBCOMMAND",
                        help=f"{', '.join(SUBCOMMANDS)} or all (default)")
    parser.add_argument("--quick", action="store_true", help="a minute a subcommand, with fewer repeats and sizes")
    parser.add_argument("--json", metavar="FILE", type=pathlib.Path, help="results as one JSON object")
    parser.add_argument("--html", metavar="FILE", type=pathlib.Path, help="results as a page with plots")
    parser.add_argument("--mitsuba", metavar="PYTHON", default="python3", help="a Python that has Mitsuba 3")
    parser.add_argument("--luxcore", metavar="PYTHON", default="python3", help="a Python that has pyluxcore")
    parser.add_argument("--cycles", metavar="PYTHON",
                        help="a Python that has Blender's module bpy, instead of the blender command")
    parser.add_argument("--scene", metavar="NAME", action="append", default=[],
                        help="time-to-error and gallery: only scenes with NAME in their name; may be given again")
    parser.add_argument("--threads", type=positive, default=1, help="of every renderer in time-to-error (default 1)")
    parser.add_argument("--reference-spp", type=positive, metavar="N",
                        help="samples a pixel that time-to-error's references have at least (default 8192, quick 1024)")
    parser.add_argument("--processor-time", action="store_true",
                        help="traversal on one thread by the processor's time: for machines that others use too")
    parser.add_argument("--check-arguments", action="store_true", help=argparse.SUPPRESS)
    return parser.parse_args()


def context_of(options, scratch):
    data = pathlib.Path(os.environ.get("PARHELION_DATA", ROOT.parent / "shared" / "data"))
    release = ROOT / "build" / "release"
    return Context(root=ROOT, program=release / "parhelion", native=release / "benchmarks" / "parhelion_bench",
                   work=WORK, scratch=scratch, data=data if data.is_dir() else None, quick=options.quick,
                   processor_time=options.processor_time, threads=options.threads,
                   reference_spp=options.reference_spp or (1024 if options.quick else 8192), mitsuba=options.mitsuba,
                   luxcore=options.luxcore, cycles=options.cycles, only=tuple(options.scene))


def measure(context, names):
    document = {"hardware": machine.hardware(), "versions": machine.versions(context), "started": machine.now(),
                "quick": context.quick, "results": {}, "checks": [], "failed": {}}
    for name in names:
        say(name)
        try:
            result, checks = SUBCOMMANDS[name](context)
        except Failure as e:  # the others' results are not lost with it
            say(f"{name}: {e}")
            document["failed"][name] = str(e)
            continue
        document["results"][name] = result
        document["checks"] += checks
    document["ended"] = machine.now()
    return document


def write(path, text):
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(text, encoding="utf-8")
    say(f"wrote {path}")


def summary(document):
    rows = document["checks"]
    for row in rows:
        value = "none" if row["value"] is None else f"{row['value']:.4g}"
        print(f"{'holds' if row['holds'] else 'MISSED':6}  {value:>9}  ({row['target']})  {row['name']}")
    print(f"{sum(r['holds'] for r in rows)} of {len(rows)} targets hold")


def main():
    options = arguments()
    if options.check_arguments:
        return
    WORK.mkdir(parents=True, exist_ok=True)
    names = SUBCOMMANDS if options.subcommand == "all" else [options.subcommand]
    with tempfile.TemporaryDirectory(prefix="run-", dir=WORK) as scratch:
        document = measure(context_of(options, pathlib.Path(scratch)), names)
    neither = not options.json and not options.html
    name = options.subcommand
    if options.json or neither:
        write(options.json or WORK / f"{name}.json", json.dumps(document, indent=1) + "\n")
    if options.html or neither:
        write(options.html or WORK / f"{name}.html", page.render(document))
    summary(document)
    if document["failed"]:
        sys.exit(4)


if __name__ == "__main__":
    main()
