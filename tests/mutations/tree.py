"""The copy of the sources that has all faults at once, and what its build has to be told."""

import dataclasses
import json
import re
import subprocess

import schemata

HEADER = """// Made by tests/mutations: which fault this process has.
#pragma once
#include <cstdlib>
inline const int parhelion_mutant = [] {
    const char* number = std::getenv("PARHELION_MUTANT");
    return number ? std::atoi(number) : 0;
}();
#define MUTANT ::parhelion_mutant
"""
# What a compiler finds odd about faults, which need not stop it.
HEADER += "".join(
    f'#pragma GCC diagnostic ignored "-W{name}"\n'
    for name in """duplicated-branches duplicated-cond logical-op parentheses unused-variable
    unused-parameter unused-but-set-variable unused-function unused-value type-limits sign-compare
    bool-compare maybe-uninitialized bool-operation int-in-bool-context tautological-compare
    redundant-move pessimizing-move div-by-zero aggressive-loop-optimizations array-bounds
    misleading-indentation return-type""".split()
)
# Where C++ takes in the kernels' text, and what they share.
TAKES_IN_KERNELS = re.compile(r'^\s*#include "(?:kernels/\w+\.cl|device/)', re.M)
TAKES_IN_SHARED = re.compile(r'^\s*#include "kernels/shared/shared\.h', re.M)


def with_number(file, text):
    """The file, which is told what MUTANT is; its lines keep their numbers."""
    return f'#include "host/mutant.h"\n#line 1 "{file}"\n{text}'


def changed_texts(texts, mutants):
    """file -> text, of all files that are not as they were. texts: of all files, as they were."""
    by_file = {}
    for m in mutants:
        by_file.setdefault(m.file, []).append(m)
    changed = {"host/mutant.h": HEADER}
    for file, own in by_file.items():
        text = schemata.with_mutants(texts[file], own)
        if file.endswith("cie_tables.h"):
            text = text.replace("inline constexpr CieTable", "inline const CieTable")
            text = text.replace("inline constexpr double", "inline const double")
        changed[file] = text if re.search(r"^kernels/|\.inl$", file) else with_number(file, text)
    # Of tables: the file that they are part of.
    shared = any(file.startswith("kernels/shared/") for file in by_file)
    for file, text in texts.items():
        if file.startswith("host/") and file not in changed:
            tables = re.findall(r'#include "([^"]+\.inl)"', text)
            if (
                TAKES_IN_KERNELS.search(text)
                or (shared and TAKES_IN_SHARED.search(text))
                or any(name in by_file for name in tables)
            ):
                changed[file] = with_number(file, text)
    # Kernels are told the number where the fault is theirs: their programs are kept otherwise.
    last = max((m.number for m in mutants if m.file.startswith("kernels/")), default=0)
    file = "host/cl/program.cpp"
    told = f'"-DMUTANT=" + std::to_string(MUTANT <= {last} ? MUTANT : 0) + " " + fmt::format("-cl-std'
    text, count = re.subn(r'fmt::format\(\s*"-cl-std', told, texts[file])
    if count != 1:
        raise SystemExit(f"{file}: where are the options of kernels made?")
    changed[file] = with_number(file, text)
    return changed


def sources(root):
    """file -> bytes, of all that the repository has."""
    listed = subprocess.run(
        ["git", "ls-files", "-z", "--cached", "--others", "--exclude-standard"],
        cwd=root,
        capture_output=True,
        check=True,
    ).stdout
    names = [name for name in listed.decode().split("\0") if name]
    return {name: (root / name).read_bytes() for name in names if (root / name).is_file()}


def write(folder, files, mutants):
    """Writes only what differs from what lies there, so that the next draw builds less."""
    texts = {
        name: data.decode()
        for name, data in files.items()
        if name.startswith(("host/", "kernels/")) and not name.endswith(".bin")
    }
    changed = {name: text.encode() for name, text in changed_texts(texts, mutants).items()}
    for name, data in {**files, **changed}.items():
        target = folder / name
        if target.exists() and target.read_bytes() == data:
            continue
        target.parent.mkdir(parents=True, exist_ok=True)
        target.write_bytes(data)
    records = [dataclasses.asdict(m) for m in mutants]
    (folder / "mutants.json").write_text(json.dumps(records, indent=1) + "\n")
