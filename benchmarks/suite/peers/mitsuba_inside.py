"""Runs in a Python that has Mitsuba 3: renders one scene file with several samples and seeds."""
import json
import pathlib
import sys
import time

import drjit
import mitsuba

sys.path.append(str(pathlib.Path(__file__).parent))
from job_list import run_jobs  # noqa: E402


def load(order):
    """The scene with a float32 film of the wanted size."""
    config = mitsuba.parser.ParserConfig(order["variant"])
    config.unused_properties = mitsuba.LogLevel.Debug  # of older files, which it would refuse otherwise
    path = pathlib.Path(order["scene"])
    mitsuba.file_resolver().prepend(str(path.parent))
    state = mitsuba.parser.parse_file(config, str(path))
    mitsuba.parser.transform_all(config, state)
    for node in state.nodes:
        if node.type == mitsuba.ObjectType.Film:
            node.props["component_format"] = "float32"
            node.props["width"] = node.props["height"] = order["size"]
    loaded = mitsuba.parser.instantiate(config, state)
    return loaded[0] if isinstance(loaded, list) else loaded


def timed_render(scene, spp, seed):
    start = time.perf_counter()
    image = mitsuba.render(scene, spp=spp, seed=seed)
    drjit.eval(image)
    drjit.sync_thread()
    return image, time.perf_counter() - start


def main():
    order = json.loads(sys.argv[-1])
    mitsuba.set_variant(order["variant"])
    mitsuba.set_log_level(mitsuba.LogLevel.Error)
    drjit.set_thread_count(max(2, order["threads"]))  # with one thread, loading several images waits for ever
    scene = load(order)
    drjit.set_thread_count(order["threads"])
    warm = set()

    def render(job):
        begin = time.perf_counter()
        warm_up = 0.0
        if order["warm_up"] and job["spp"] not in warm:
            _, warm_up = timed_render(scene, job["spp"], 12345)
            warm.add(job["spp"])
        image, seconds = timed_render(scene, job["spp"], job["seed"])
        drjit.set_thread_count(max(2, order["threads"]))  # with one thread its EXR code waits for ever
        mitsuba.Bitmap(image).write(job["output"])
        drjit.set_thread_count(order["threads"])
        return {"seconds": seconds, "warm_up_seconds": warm_up, "busy_seconds": time.perf_counter() - begin}

    for _, result in run_jobs(order, render):
        print("RESULT", json.dumps(result), flush=True)


main()
