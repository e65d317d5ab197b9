"""Puts the figures of a stress report into the table of functions of docs/accuracy.md.

    parhelion stress --filter Functions --json functions.json
    python docs/function_table.py functions.json [MORE.json...]

The run of most inputs has its row; rows that no report has stay as they are.
"""

import json
import pathlib
import sys

PAGE = pathlib.Path(__file__).resolve().parent / "accuracy.md"
HEAD = "| function | worst | mean | allowed | unit | inputs |\n|---|---|---|---|---|---|\n"


def number(value):
    if value is None:
        return ""
    if value == 0 or 0.01 <= abs(value) < 1e4:
        return f"{value:.3g}"
    return f"{value:.2e}"


def row(check):
    cells = [number(check["value"]), number(check.get("mean")), number(check["target"]), check["unit"],
             f"{check['samples']:.2g}"]
    return f"| {check['name']} | " + " | ".join(cells) + " |\n"


def wanted(check):
    return check["chapter"] == "Functions" and check["row"] != "same_bits" and "bits that differ" not in check["name"]


def inputs(line):
    return float(line.split("|")[6])


def main(reports):
    before, rest = PAGE.read_text().split(HEAD)
    table, after = rest.split("\n\n", 1)
    rows = {line.split(" | ")[0].strip("| "): line + "\n" for line in table.split("\n")}
    for report in reports:
        for check in json.loads(pathlib.Path(report).read_text())["checks"]:
            line, before_it = row(check), rows.get(check["name"])
            if wanted(check) and (before_it is None or inputs(line) >= inputs(before_it)):
                rows[check["name"]] = line
    PAGE.write_text(before + HEAD + "".join(rows.values()) + "\n" + after)


if __name__ == "__main__":
    main(sys.argv[1:])
