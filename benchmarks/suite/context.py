"""Where things are, running programs, and telling the user how far we are."""
import dataclasses
import json
import os
import pathlib
import subprocess
import sys
import threading
import time


class Failure(Exception):
    """Ends a subcommand; its text is one line for the user."""


@dataclasses.dataclass(frozen=True)
class Context:
    root: pathlib.Path     # of the checkout
    program: pathlib.Path  # parhelion
    native: pathlib.Path   # parhelion_bench
    work: pathlib.Path     # what is kept between runs
    scratch: pathlib.Path  # this run's own, empty at its start
    data: pathlib.Path | None  # shared scenes, where there are some
    quick: bool
    processor_time: bool
    threads: int           # for the images beside other renderers
    reference_spp: int     # samples a pixel that references have at least
    mitsuba: str           # a Python that has Mitsuba 3
    luxcore: str           # a Python that has pyluxcore
    only: tuple            # parts of names of time-to-error's scenes; all where there are none
    cycles: str | None     # a Python that has Blender's module, to be taken instead of the blender command

    def scene(self, name):
        return self.root / "scenes" / name

    def folder(self, name):
        path = self.work / name
        path.mkdir(parents=True, exist_ok=True)
        return path


@dataclasses.dataclass(frozen=True)
class Finished:
    """A program that ran: what it printed, the wall clock, its processor time and most memory."""
    stdout: str
    stderr: str
    seconds: float
    peak_bytes: int


def say(text):
    print(f"bench: {text}", file=sys.stderr, flush=True)


def cores():
    return len(os.sched_getaffinity(0))


def thread_counts():
    """1, and 2 where there are as many cores."""
    return [1, 2] if cores() > 1 else [1]


def run(command, environment=None, folder=None, accepted=(0,), show_progress=False):
    """Runs a program to its end. Its peak memory comes from the wait, so that it is this child's alone."""
    start = time.perf_counter()
    process = subprocess.Popen([str(c) for c in command], cwd=folder, text=True, errors="replace",
                               env={**os.environ, **(environment or {})}, stdout=subprocess.PIPE,
                               stderr=None if show_progress else subprocess.PIPE, stdin=subprocess.DEVNULL)
    with process:
        stdout, stderr, usage = _collect(process)
    seconds = time.perf_counter() - start
    if process.returncode not in accepted:
        last = ((stderr or stdout).strip().splitlines() or ["nothing printed"])[-1]
        raise Failure(f"{command[0]} ended with {process.returncode}: {last}")
    return Finished(stdout, stderr, seconds, usage.ru_maxrss * 1024)


def _collect(process):
    """What the child prints until it ends, and its resource usage."""
    texts = {"stdout": "", "stderr": ""}

    def read(name):
        stream = getattr(process, name)
        if stream:
            texts[name] = stream.read()

    readers = [threading.Thread(target=read, args=(name,)) for name in texts]
    for reader in readers:
        reader.start()
    _, status, usage = os.wait4(process.pid, 0)
    process.returncode = os.waitstatus_to_exitcode(status)
    for reader in readers:
        reader.join()
    return texts["stdout"], texts["stderr"], usage


def read_json(path):
    return json.loads(pathlib.Path(path).read_text(encoding="utf-8"))


def check(name, value, least=None, most=None, note=""):
    """A row of the checks: a measured value against its target."""
    holds = value is not None and (least is None or value >= least) and (most is None or value <= most)
    target = f"at least {least:g}" if least is not None else f"at most {most:g}"
    return {"name": name, "value": value, "target": target, "holds": holds, **({"note": note} if note else {})}
