"""The scenes of time-to-error, and what their images are held against."""
import dataclasses
import hashlib
import pathlib

from . import exr
from .context import run, say, thread_counts
from .renderer import render

REFERENCE_SEED = 900_001
STEP_SPP = 8192
SIZE, CLOSED_FORM_SIZE = 128, 64


@dataclasses.dataclass(frozen=True)
class Case:
    name: str
    scene: pathlib.Path
    size: int              # pixels a side
    levels: tuple          # RMSE at which times are compared
    truth: tuple | None = None  # the colour of every pixel, where it is known
    relative_levels: bool = False  # levels are in units of the reference's mean
    pbrt: str | None = None  # its name in PBRT
    least: float = 4         # how many times as fast as Cycles and Mitsuba's LLVM variant we want to be


# pbrt-v4, one core of this kind of machine, 128x128: (spp, seconds, RMSE to the mean of its own 512-spp images).
# Measured once for this project, another day than the rest of a report.
PBRT = {
    "cornell": [(1, .113, .33325), (4, .442, .14860), (16, 1.703, .03123), (64, 8.051, .01122), (256, 30.365, .00515),
                (512, 78.079, .00380)],
    "spheres": [(1, .131, .44455), (4, .536, .18953), (16, 2.073, .06761), (64, 9.087, .02856), (256, 40.514, .01517),
                (512, 86.222, .01084)],
    "bunny_env": [(1, .207, .29316), (4, .442, .15114), (16, 1.509, .04708), (64, 5.878, .02096),
                  (256, 24.573, .01021), (512, 42.988, .00732)],
    "bunny_point": [(1, .224, .09533), (4, .527, .04952), (16, 1.675, .01510), (64, 6.220, .00657),
                    (256, 26.768, .00322), (512, 48.934, .00229)],
}

LEVELS = (0.04, 0.02, 0.01)
RELATIVE_LEVELS = (0.32, 0.16, 0.08)
TEXTURED_LEAST = 3
REAL = [
    ("Cornell box", "cornell-box/scene.xml", "cornell"),
    ("glass and metal", "glass-and-metal/scene.xml", "spheres"),
    ("bunny, sky", "bunny/env.xml", "bunny_env"),
    ("bunny, point light", "bunny/point.xml", "bunny_point"),
]
TEXTURED = [
    ("court in the sun", "sunlit/scene.xml"),
    ("hall of tiles", "sunlit/hall.xml"),
]
# Below the shared data; rendered at 128 x 128 with the filter they ask for.
SHARED = [
    ("Mitsuba's Cornell box", "scenes-mitsuba/cornell-box/scene_path.xml", 4),
    ("Mitsuba 2's Cornell box", "scenes-mitsuba/cbox-m2/scene.xml", 4),
    ("living room", "scenes-mitsuba/living-room/scene.xml", TEXTURED_LEAST),
    ("staircase", "scenes-mitsuba/staircase2/scene.xml", TEXTURED_LEAST),
]
# Every pixel of these is one colour (scenes/README.md has the formulas).
CLOSED_FORM = [
    ("rectangle light", "rectangle_light", (0.8 * 0.194980345804875, 0.5 * 2 * 0.194980345804875,
                                            0.2 * 4 * 0.194980345804875)),
    ("half-blocked sky", "half_blocked_sky", (0.6, 0.75, 0.6)),
    ("diffuse under glass", "hemispherical_fresnel", tuple(
        0.04 + 0.96 * r * (1 - 0.596345759707712) / (1 - r * 0.596345759707712) for r in (0.9, 0.5, 0.2))),
    ("closed box", "enclosure_box", (5.0, 4.0, 5.0)),
]


def cases(context):
    """Those that can be rendered here, and why others cannot."""
    made = [Case(name, context.scene(file), SIZE, LEVELS, pbrt=pbrt) for name, file, pbrt in REAL]
    absent = []
    made += [Case(name, context.scene(file), SIZE, RELATIVE_LEVELS, relative_levels=True, least=TEXTURED_LEAST)
             for name, file in TEXTURED]
    for name, file, least in SHARED:
        if context.data and (context.data / file).exists():
            made.append(Case(name, context.data / file, SIZE, RELATIVE_LEVELS, relative_levels=True, least=least))
        else:
            absent.append(f"{name}: skipped, PARHELION_DATA has no {file}")
    made += [Case(name, context.scene(f"closed_form/{folder}/scene.xml"), CLOSED_FORM_SIZE, (0.08, 0.04, 0.02), truth=truth,
                  relative_levels=True) for name, folder, truth in CLOSED_FORM]
    if context.only:
        return [c for c in made if any(word in c.name for word in context.only)], absent
    if context.quick:
        made = [made[0], made[3], next(c for c in made if c.truth)]
    return made, absent


def reference(context, case):
    """{image, spp}: the truth as an image, or long renders of our own that are kept."""
    folder = context.folder("references")
    if case.truth:
        image = folder / f"{case.scene.parent.name}.exr"
        exr.write_constant(image, case.size, case.size, case.truth)
        return {"image": image, "spp": None}
    key = hashlib.sha256(case.scene.read_bytes() + f"{case.size}".encode()).hexdigest()[:12]
    kept = {int(p.stem.split("-")[1]): p for p in folder.glob(f"{key}-*.exr")}
    spp = max(kept, default=0)
    while spp < context.reference_spp:
        spp = _grow(context, case, folder, key, spp, kept.get(spp))
        kept = {spp: folder / f"{key}-{spp}.exr"}
    return {"image": kept[spp], "spp": spp}


def _grow(context, case, folder, key, spp, image):
    """Renders more samples with a seed of their own and takes them into the mean; returns how many there are then."""
    more = min(STEP_SPP, context.reference_spp - spp)
    say(f"{case.name}: {more} more samples a pixel for the reference, which has {spp}")
    part = render(context, case.scene, spp=more, size=case.size, threads=max(thread_counts()),
                  seed=REFERENCE_SEED + spp, output=context.scratch / "part.exr")["image"]
    images = [(part, more)] + ([(image, spp)] if image else [])
    target = folder / f"{key}-{spp + more}.exr"
    run([context.native, "average", "--output", target,
         *(a for file, weight in images for a in ("--image", file, "--weight", weight))])
    if image:
        image.unlink()
    return spp + more
