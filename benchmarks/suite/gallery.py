"""gallery: each scene's picture, a long render of it, where they differ, and what it took."""
import base64

from . import error_cases, exr
from .context import run, say
from .renderer import compare, render

SPP = 64


def gallery(context):
    size, reference_spp = (96, 256) if context.quick else (256, 2048)
    cases, absent = error_cases.cases(context)
    rows = []
    for case in cases:
        if not case.truth:  # a picture of one colour
            say(f"gallery: {case.name}")
            rows.append(_row(context, case, size, reference_spp))
    return {"scenes": rows, "skipped": absent, "spp": SPP, "size": size, "reference_spp": reference_spp}, []


def _row(context, case, size, reference_spp):
    ours = render(context, case.scene, spp=SPP, size=size, threads=0, output=context.scratch / "picture.exr")
    truth = render(context, case.scene, spp=reference_spp, size=size, threads=0, seed=error_cases.REFERENCE_SEED,
                   output=context.scratch / "truth.exr")
    black = context.scratch / "black.exr"
    exr.write_constant(black, size, size, (0, 0, 0))
    pictures = [("picture", _drawn(context, ours["image"], black, "--difference-image")),
                ("reference", _drawn(context, truth["image"], black, "--difference-image")),
                ("difference", _drawn(context, ours["image"], truth["image"], "--difference-image")),
                ("FLIP", _drawn(context, ours["image"], truth["image"], "--flip-image"))]
    figures = compare(context, ours["image"], truth["image"])
    return {"name": case.name, "seconds": ours["time"]["render_seconds"],
            "reference_seconds": truth["time"]["render_seconds"],
            **{key: figures[key] for key in ("rmse", "relmse", "flip", "mean")}, "pictures": pictures}


def _drawn(context, image, reference, kind):
    """What `compare` draws of two images, as a data URI; an image's difference from black is the image."""
    file = context.scratch / "drawn.png"
    run([context.program, "compare", image, reference, "--common", "--force", kind, file])
    return "data:image/png;base64," + base64.b64encode(file.read_bytes()).decode()
