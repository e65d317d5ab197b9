"""Which other renderers are on this machine."""
import os
import pathlib
import re
import shutil

from .runner import Peer, answer_of


def newest_llvm():
    """Mitsuba's llvm variants take any LLVM library, but some old ones fail on its code (Debian's 15 and 16 do)."""
    found = [(int(m[1]), path) for path in pathlib.Path("/usr/lib").glob("*-linux-gnu/libLLVM*.so*")
             if (m := re.search(r"libLLVM(?:-|\.so\.)(\d+)", path.name))]
    if "DRJIT_LIBLLVM_PATH" in os.environ or not found:
        return {}
    return {"DRJIT_LIBLLVM_PATH": str(max(found)[1])}


def mitsuba(context):
    version = answer_of([context.mitsuba, "-c", "import mitsuba; print(mitsuba.__version__)"])
    if not version:
        return [], f"Mitsuba 3: skipped, {context.mitsuba} cannot import mitsuba (from PyPI; name another with --mitsuba)"
    peers = [Peer(f"Mitsuba {variant}", version, (context.mitsuba,), "mitsuba_inside.py", {"variant": variant},
                  warm_up=variant.startswith("llvm"), most_spp=256, environment=newest_llvm()) for variant in ("scalar_rgb", "llvm_ad_rgb")]
    return peers, None


def cycles(context):
    """Of the `blender` command, or of a Python that has Blender as a module."""
    program = shutil.which("blender")
    if program and not context.cycles:
        version = answer_of(["sh", "-c", f"'{program}' --version | head -n 1"])
        prefix = (program, "-b", "--factory-startup", "-t", str(context.threads), "-P")
        return [Peer("Cycles", version, prefix, "cycles_inside.py", {}, separator=("--",))], None
    python = context.cycles or "python3"
    version = answer_of([python, "-c", "import bpy; print('Blender', bpy.app.version_string)"])
    if not version:
        return [], f"Cycles: skipped, there is no blender (Debian's package blender), and {python} cannot import bpy " \
                   "(from PyPI; name another with --cycles)"
    return [Peer("Cycles", version, (python,), "cycles_inside.py", {})], None


def luxcore(context):
    version = answer_of([context.luxcore, "-c", "import pyluxcore; pyluxcore.Init(); print(pyluxcore.Version())"])
    # It looks at every OpenCL device though it needs none, and PoCL brings it down.
    environment = {"OCL_ICD_VENDORS": "/nonexistent"}
    if not version:
        return [], f"LuxCore: skipped, {context.luxcore} cannot import pyluxcore (from PyPI; name another with --luxcore)"
    return [Peer("LuxCore", version, (context.luxcore,), "luxcore_inside.py", {}, environment=environment)], None


def found(context):
    """(peers, reasons of those that are absent)."""
    peers, absent = [], []
    for find in (mitsuba, cycles, luxcore):
        some, reason = find(context)
        peers += some
        if reason:
            absent.append(reason)
    return peers, absent
