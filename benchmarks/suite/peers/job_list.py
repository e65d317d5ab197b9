"""The jobs that fit the time: used by every *_inside.py, in whatever Python it runs."""


def fitting(order):
    """Yields jobs in their order (samples ascending) and is sent the seconds each took; ends before one that would
    take more than what is left of the budget, judging by the last."""
    left, rate = order["budget_seconds"], 0.0
    for number, job in enumerate(order["jobs"]):
        if number and rate * job["spp"] > left:
            return
        seconds = yield job
        left -= seconds
        rate = seconds / job["spp"]


def run_jobs(order, render):
    """Calls render(job) -> {seconds, busy_seconds} for the jobs that fit; gives (job, result) as they come."""
    jobs = fitting(order)
    job = next(jobs, None)
    while job:
        result = render(job)
        yield job, result
        try:
            job = jobs.send(result["seconds"] + result.get("warm_up_seconds", 0.0))
        except StopIteration:
            return
