"""Running our own program: an image and the statistics of its making; two images compared."""
import json

from .context import read_json, run


def render(context, scene, *, spp, size=512, threads=1, seed=0, options=(), environment=None, output=None):
    """Renders a scene file, `size` pixels a side.

    Returns its --stats with `process_seconds`, `peak_bytes` and `image`, the file."""
    image = output or context.scratch / "ours.exr"
    stats = image.with_suffix(".json")
    done = run([context.program, "render", scene, "-o", image, "--stats", stats, "--force", "--quiet", "--allow-outside",
                "--no-energy-compensation", "--shading-normals", "raw",  # as the others have them
                "--size", f"{size}x{size}", "--spp", spp, "--threads", threads, "--seed", seed, *options], environment)
    return {**read_json(stats), "process_seconds": done.seconds, "peak_bytes": done.peak_bytes, "image": image}


def compare(context, image, reference):
    """{rmse, relmse, flip, bias_relative, mean} of an image against a reference."""
    report = json.loads(run([context.program, "compare", image, reference, "--json", "--common"]).stdout)
    return {"rmse": report["all"]["rmse"], "relmse": report["all"]["relmse"], "flip": report["flip"]["mean"],
            "bias_relative": report["all"]["bias_relative"], "mean": report["all"]["mean_image"]}


def kernel_seconds(stats):
    return {s["name"]: s["kernel_seconds"] for s in stats["stages"]}
