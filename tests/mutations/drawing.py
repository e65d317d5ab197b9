"""Which faults there are, and which of them a seed draws."""

import fnmatch
import pathlib
import random

import schemata

HERE = pathlib.Path(__file__).resolve().parent

SOURCES = [
    "kernels/*.cl",
    "kernels/shared/*.h",
    "kernels/device/*.h",
    "host/flatten/*.cpp",
    "host/film/*.cpp",
    "host/waves/render_params.cpp",
    "host/image/metrics.cpp",
    "host/image/own_variance.cpp",
    "host/image/z_test.cpp",
    "host/commands/compare.cpp",
    "host/commands/overrides.cpp",
    "host/scene/mitsuba/bsdfs.cpp",
    "host/scene/mitsuba/emitters.cpp",
    "host/scene/mitsuba/film.cpp",
    "host/scene/mitsuba/integrators.cpp",
    "host/scene/mitsuba/sensor.cpp",
    "host/scene/mitsuba/shapes.cpp",
    "host/scene/mitsuba/spectrum.cpp",
    "host/scene/mitsuba/transforms.cpp",
]
TABLES = ["host/scene/mitsuba/conductor_presets.inl", "host/scene/mitsuba/cie_tables.h"]
# What does not decide values: languages, memory, how rays are traced in packets, work and programs.
LEFT_OUT = [
    "kernels/self_test.cl",
    "kernels/shared/lane.h",
    "kernels/shared/types.h",
    "kernels/shared/features.h",
    "kernels/shared/records.h",
    "kernels/shared/shared.h",
    "kernels/device/device.h",
    "kernels/device/buffers.h",
    "kernels/device/lanes_memory.h",
    "kernels/device/state.h",
    "kernels/device/notes.h",
    "kernels/device/shade_work.h",
    "kernels/device/traver*",
]


def files(root):
    left_out = {path for pattern in LEFT_OUT for path in root.glob(pattern)}
    found = {path for pattern in SOURCES for path in root.glob(pattern)}
    return [str(p.relative_to(root)) for p in sorted(found - left_out)]


def equivalent_keys():
    lines = (HERE / "equivalent.txt").read_text().splitlines()
    return {line for line in lines if " | " in line and not line.startswith("#")}


def all_mutants(root):
    """Of the sources as they are now."""
    found = []
    for file in files(root):
        found += schemata.mutants_of(file, (root / file).read_text())
    for file in TABLES:
        found += schemata.numbers_of(file, (root / file).read_text())
    unique = {}
    for m in found:
        unique.setdefault((m.file, m.span, m.changed), m)
    return list(unique.values())


def draw(mutants, seed, count, patterns=()):
    """`count` of them, of files that match a pattern: a file (by the root of its faults), a kind in it, and one of that kind."""
    generator = random.Random(seed)
    known = equivalent_keys()
    by_file = {}
    for m in mutants:
        if patterns and not any(fnmatch.fnmatch(m.file, p) for p in patterns):
            continue
        by_file.setdefault(m.file, {}).setdefault(m.kind, []).append(m)
    drawn = []
    while by_file and len(drawn) < count:
        names = sorted(by_file)
        weights = [sum(map(len, by_file[n].values())) ** 0.5 for n in names]
        kinds = by_file[generator.choices(names, weights)[0]]
        kind = generator.choice(sorted(kinds))
        m = kinds[kind].pop(generator.randrange(len(kinds[kind])))
        # After the draw, so that a line more there does not make another draw of it.
        if m.key() not in known:
            drawn.append(m)
        by_file[m.file] = {k: v for k, v in kinds.items() if v}
        by_file = {name: kinds for name, kinds in by_file.items() if kinds}
    # Kernels first: a program of theirs need not be compiled again for a fault of the host's.
    drawn.sort(key=lambda m: (not m.file.startswith("kernels/"), m.file, m.span, m.changed))
    for number, m in enumerate(drawn, 1):
        m.number = number
    return drawn
