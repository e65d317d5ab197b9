"""Running our own program: an image and the statistics of its making; two images compared."""
import json

from .context import read_json, run


def render(context, scene, *, spp, size=512, threads=1, seed=0, options=(), environment=None, output=None):
    """Renders a scene file; `size`: pixels a side, None as the file says.

    Returns its --stats with `process_seconds`, `peak_bytes`, `image_pixels` and `image`, the file."""
    folder = context.folder("images")
    image = output or folder / "ours.exr"
    stats = image.with_suffix(".json")
    sized = ["--size", f"{size}x{size}"] if size else []
    done = run([context.program, "render", scene, "-o", image, "--stats", stats, "--force", "--quiet", "--allow-outside",
                "--spp", spp, "--threads", threads, "--seed", seed, *sized, *options], environment)
    report = read_json(stats)
    pixels = (report["image"]["width_pixels"], report["image"]["height_pixels"])
    return {**report, "process_seconds": done.seconds, "peak_bytes": done.peak_bytes, "image": image,
            "image_pixels": pixels}


def compare(context, image, reference):
    """{rmse, relmse, flip, bias_relative, mean} of an image against a reference."""
    report = json.loads(run([context.program, "compare", image, reference, "--json"]).stdout)
    return {"rmse": report["all"]["rmse"], "relmse": report["all"]["relmse"], "flip": report["flip"]["mean"],
            "bias_relative": report["all"]["bias_relative"], "mean": report["all"]["mean_image"]}


def kernel_seconds(stats):
    return {s["name"]: s["kernel_seconds"] for s in stats["stages"]}
