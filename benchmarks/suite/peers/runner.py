"""Calling another renderer's Python on a list of jobs."""
import dataclasses
import json
import pathlib

from ..context import Failure, run

HERE = pathlib.Path(__file__).parent


@dataclasses.dataclass(frozen=True)
class Peer:
    """`prefix`: the command that runs a Python file inside the renderer; `settings` go to it with the jobs."""
    name: str
    version: str
    prefix: tuple
    script: str
    settings: dict
    warm_up: bool = False  # compiles on first use: each number of samples is rendered once before it counts
    most_spp: int = 1 << 20
    environment: dict = dataclasses.field(default_factory=dict)
    separator: tuple = ()  # what stands before arguments that are the script's own

    def render(self, scene, size, threads, jobs, budget_seconds):
        """jobs: [{spp, seed, output}], samples ascending. Gives those that fitted the budget, with seconds and
        process_seconds (start included).

        Raises Failure with the reason where the scene cannot be translated."""
        order = {**self.settings, "scene": str(scene), "size": size, "threads": threads, "warm_up": self.warm_up,
                 "budget_seconds": budget_seconds,
                 "jobs": [{**job, "output": str(job["output"])} for job in jobs]}
        done = run([*self.prefix, HERE / self.script, *self.separator, json.dumps(order)],
                   self.environment, accepted=(0, 1, 3))
        results = [json.loads(line.split(" ", 1)[1]) for line in done.stdout.splitlines()
                   if line.startswith("RESULT ")]
        if not results:
            refusals = [line for line in done.stdout.splitlines() if line.startswith("REFUSED ")]
            last = (done.stderr or done.stdout).strip().splitlines()[-1:]
            raise Failure(refusals[0].split(" ", 1)[1] if refusals else f"{self.name} failed: {' '.join(last)}")
        start = done.seconds - sum(r["busy_seconds"] for r in results)
        return [{**job, **r, "process_seconds": start + r["busy_seconds"] - r.get("warm_up_seconds", 0)}
                for job, r in zip(jobs, results)]


def answer_of(command, accepted=(0,)):
    """The last line a command prints, or None where it cannot be run."""
    try:
        lines = run(command, accepted=accepted).stdout.strip().splitlines()
    except (Failure, OSError):
        return None
    return lines[-1] if lines else None
