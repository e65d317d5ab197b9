"""The page: one HTML file with its plots inside, that needs nothing else."""
import html
import json

from . import page_sections

STYLE = """body{font:15px/1.45 sans-serif;max-width:1300px;margin:24px auto;padding:0 16px;color:#222}
table{border-collapse:collapse;margin:10px 0}td,th{border:1px solid #ccc;padding:3px 8px;text-align:right}
td:first-child,th:first-child{text-align:left}.missed{background:#fbe3e0}.plots{display:flex;flex-wrap:wrap;gap:14px}
.plots svg{width:620px;max-width:100%;border:1px solid #ddd}details{margin:10px 0}pre{overflow:auto;max-height:400px}"""


def cell(value):
    if value is None:
        return ""
    if isinstance(value, float):
        return f"{value:.4g}"
    return html.escape(str(value))


def table(head, rows, marks=None):
    """`marks`: the class of each row, or None."""
    lines = ["<table><tr>" + "".join(f"<th>{html.escape(h)}</th>" for h in head) + "</tr>"]
    for i, row in enumerate(rows):
        mark = f' class="{marks[i]}"' if marks and marks[i] else ""
        lines.append(f"<tr{mark}>" + "".join(f"<td>{cell(v)}</td>" for v in row) + "</tr>")
    return "\n".join([*lines, "</table>"])


def plots(drawings):
    return '<div class="plots">' + "\n".join(d for d in drawings if d) + "</div>"


def _facts(document):
    rows = []
    for key, value in {**document["hardware"], **document["versions"]}.items():
        if isinstance(value, dict):
            value = "; ".join(f"{k} {v}" for k, v in value.items())
        rows.append((key, value))
    return table(["measured on", ""], [*rows, ("started", document["started"]), ("ended", document["ended"])])


def _checks(checks):
    held = sum(row["holds"] for row in checks)
    rows = [(row["name"], row["value"], row["target"], "holds" if row["holds"] else "missed", row.get("note"))
            for row in checks]
    return f"<h2>Targets: {held} of {len(checks)} hold</h2>" + table(
        ["target", "value", "", "", ""], rows, [None if row["holds"] else "missed" for row in checks])


def render(document):
    """The page as text."""
    parts = ["<!doctype html><html lang=\"en\"><head><meta charset=\"utf-8\"><title>Parhelion benchmarks</title>",
             f"<style>{STYLE}</style></head><body><h1>Parhelion benchmarks</h1>", _facts(document)]
    if document["quick"]:
        parts.append("<p>A quick run: fewer repeats and sizes.</p>")
    parts += [f"<p>{name} failed: {html.escape(text)}</p>" for name, text in document["failed"].items()]
    parts.append(_checks(document["checks"]))
    for name, result in document["results"].items():
        section = getattr(page_sections, name.replace("-", "_"))
        parts.append(f"<h2>{name}</h2>" + section(result, table, plots))
    parts.append("<details><summary>All of it as JSON</summary><pre>"
                 + html.escape(json.dumps(document, indent=1)) + "</pre></details></body></html>\n")
    return "\n".join(parts)
