#!/usr/bin/env python3
"""Hashes of the pixels of every scene in scenes/, to show that a change keeps the images' bits.

    tests/images/hashes.py build/release/parhelion                      # a line a scene, and one for all
    tests/images/hashes.py build/release/parhelion --options "--lanes 1"
    diff <(tests/images/hashes.py before/parhelion) <(tests/images/hashes.py build/release/parhelion)

Needs the Python module OpenEXR, 3.3 or later.
"""
import argparse
import hashlib
import pathlib
import shlex
import subprocess
import sys
import tempfile

import OpenEXR

ROOT = pathlib.Path(__file__).resolve().parents[2]


def pixel_hash(image):
    """Of the names and values of all channels; what else a file says may differ."""
    digest = hashlib.sha256()
    for name, channel in sorted(OpenEXR.File(str(image), separate_channels=True).channels().items()):
        digest.update(name.encode() + str(channel.pixels.shape).encode() + channel.pixels.tobytes())
    return digest.hexdigest()


def render(program, scene, options, image):
    command = [program, "render", scene, "-o", image, "--quiet", "--force", "--allow-outside", *options]
    subprocess.run([str(word) for word in command], check=True)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("program")
    parser.add_argument("--spp", type=int, default=4)
    parser.add_argument("--options", default="", help="more options of `parhelion render`")
    args = parser.parse_args()
    options = ["--spp", args.spp, *shlex.split(args.options)]
    every = hashlib.sha256()
    with tempfile.TemporaryDirectory() as folder:
        for scene in sorted(ROOT.glob("scenes/**/*.xml")):
            image = pathlib.Path(folder) / "image.exr"
            render(args.program, scene, options, image)
            line = f"{pixel_hash(image)[:16]} {scene.relative_to(ROOT / 'scenes')}"
            every.update(line.encode())
            print(line)
    print(f"{every.hexdigest()[:16]} all")


if __name__ == "__main__":
    sys.exit(main())
