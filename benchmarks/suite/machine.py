"""What the figures were measured on."""
import datetime
import os
import pathlib
import platform
import re
import subprocess

from .context import cores


def _line(command):
    try:
        run = subprocess.run(command, capture_output=True, text=True, timeout=60, check=False)
    except OSError:
        return None
    return (run.stdout.strip().splitlines() or [None])[0]


def _package(name):
    return _line(["dpkg-query", "-W", "-f", "${Version}", name])


def _processor():
    text = pathlib.Path("/proc/cpuinfo").read_text(encoding="utf-8")
    found = {key: re.search(rf"^{key}\s*:\s*(.*)$", text, re.M) for key in ("model name", "cpu MHz", "cache size")}
    flags = re.search(r"^flags\s*:\s*(.*)$", text, re.M)
    wide = [f for f in ("avx2", "avx512f", "avx512vl") if flags and f in flags[1].split()]
    return {**{key: m[1] for key, m in found.items() if m}, "vector units": " ".join(wide)}


def _caches():
    caches = {}
    for index in sorted(pathlib.Path("/sys/devices/system/cpu/cpu0/cache").glob("index*")):
        read = lambda name: (index / name).read_text(encoding="utf-8").strip()  # noqa: E731
        caches[f"L{read('level')} {read('type').lower()}"] = read("size")
    return caches


def hardware():
    memory = os.sysconf("SC_PAGE_SIZE") * os.sysconf("SC_PHYS_PAGES")
    return {"processor": _processor(), "cores": cores(), "caches of a core": _caches(),
            "memory GiB": round(memory / 2**30, 1), "load at the start": os.getloadavg()[0]}


def versions(context):
    return {"parhelion": _line([context.program, "--version"]), "system": _system(),
            "kernel": platform.release(), "python": platform.python_version(),
            "compiler": _line(["c++", "--version"]), "PoCL": _package("pocl-opencl-icd"),
            "Embree": _package("libembree-dev")}


def _system():
    for line in pathlib.Path("/etc/os-release").read_text(encoding="utf-8").splitlines():
        if line.startswith("PRETTY_NAME="):
            return line.split("=", 1)[1].strip('"')
    return platform.system()


def now():
    return datetime.datetime.now(datetime.timezone.utc).isoformat(timespec="seconds")
