"""Source files in which every fault is there at once, each behind the number MUTANT.

A statement of a function becomes a choice between its text and the texts with one fault each:

    x = (MUTANT == 7 ? (a - b) : (a + b));
"""

import dataclasses
import re

import operators


@dataclasses.dataclass
class Mutant:
    """One fault; `original` and `changed` are the statement's expression without and with it."""

    file: str
    line: int
    kind: str
    original: str
    changed: str
    span: tuple  # of the statement in the file
    shape: str  # how it is written: value, return, condition, statement or number
    number: int = 0

    def key(self):
        """What tells it from all others, wherever in the file it moves."""
        tidy = [" ".join(text.split()) for text in (self.original, self.changed)]
        return f"{self.file} | {tidy[0]} | {tidy[1]}"


def blank(text):
    """The text with comments, preprocessor lines and strings blanked out, all at their places."""

    def spaces(match):
        return re.sub(r"[^\n]", " ", match.group(0))

    def letters(match):
        return '"' + "s" * (len(match.group(0)) - 2) + '"'

    text = re.sub(r"//[^\n]*|/\*.*?\*/", spaces, text, flags=re.DOTALL)
    text = re.sub(r"^[ \t]*#(?:[^\n]*\\\n)*[^\n]*", spaces, text, flags=re.MULTILINE)
    return re.sub(r'"(?:[^"\\\n]|\\.)*"', letters, text)


def matching(text, at):
    """Where the bracket at `at` closes."""
    depth = 0
    for k in range(at, len(text)):
        depth += text[k] in "([{"
        depth -= text[k] in ")]}"
        if depth == 0:
            return k
    return len(text)


def bodies(text):
    """(begin, end) of the bodies of functions: braces behind a parameter list."""
    at, found = 0, []
    for match in re.finditer(r"\)\s*(?:const|override|noexcept|\s)*\{", text):
        begin = match.end() - 1
        if begin < at:
            continue
        line = text.rfind("\n", 0, text.rfind("(", 0, match.start() + 1)) + 1
        end = matching(text, begin)
        if "constexpr" not in text[line:begin]:
            found.append((begin + 1, end))
        at = end
    return found


def statements(text, begin, end):
    """(begin, end) of the simple statements and conditions between two places."""
    at = begin
    while at < end:
        if text[at].isspace() or text[at] in "{};":
            at += 1
            continue
        head = re.compile(r"(?:else\s+)?(if|while|for|switch)\b[^(]*\(|else\b|do\b|case\b[^:]*:|default\s*:").match(
            text, at
        )
        if head and head.group(1):
            opening = head.end() - 1
            close = matching(text, opening)
            if head.group(1) in ("if", "while"):
                yield "condition", opening + 1, close
            elif head.group(1) == "for" and text.count(";", opening, close) == 2:
                first = text.index(";", opening)
                yield "condition", first + 1, text.index(";", first + 1)
            at = close + 1
            continue
        if head:
            at = head.end()
            continue
        depth, k = 0, at
        while k < end and not (depth == 0 and text[k] == ";"):
            depth += text[k] in "([{"
            depth -= text[k] in ")]}"
            if depth < 0:
                break
            k += 1
        if k < end and text[k] == ";":
            yield "statement", at, k
        at = k + 1


def values_of(text, begin, end):
    """(shape, begin, end) of what a statement computes."""
    whole = text[begin:end]
    if re.search(r"\]\s*\(|\]\s*\{|\bstatic\b|\bconstexpr\b|\busing\b|\bstatic_assert\b|\bthrow\b|\btypedef\b|fmt::", whole):
        return
    if re.match(r"return\b", whole):
        yield "return", begin, end
        return
    depth, starts = 0, []
    for k in range(begin, end):
        depth += text[k] in "([{"
        depth -= text[k] in ")]}"
        if depth == 0 and text[k] == "=" and text[k - 1 : k + 1] not in ("==", "!=", "<=", ">="):
            if text[k + 1] != "=":
                starts.append(k + 1)
        if depth == 0 and text[k] == "," and starts and starts[-1] is not None:
            yield "value", starts[-1], k
            starts.append(None)
    if starts and starts[-1] is not None:
        yield "value", starts[-1], end
    if not starts and whole.rstrip().endswith(")") and re.match(r"[\w.:>-]+\s*\(", whole):
        yield "statement", begin, end


def mutants_of(file, text):
    """All faults of a file's functions, and of its tables' numbers."""
    plain, found = blank(text), []
    names = set()

    def add(shape, begin, end, original):
        if "{" in original and shape not in ("return", "statement"):
            return
        for kind, changed in operators.changes(original, names):
            # Beyond the end of an array: the sanitizers' business.
            if shape == "condition" and kind == "comparison" and ".size()" in original:
                continue
            line = text.count("\n", 0, begin + len(original) - len(original.lstrip())) + 1
            found.append(Mutant(file, line, kind, original, changed, (begin, end), shape))

    for begin, end in bodies(plain):
        head = max(plain.rfind(mark, 0, begin - 1) for mark in ("}", ";"))
        # Members with their dot.
        names = set(re.findall(r"(?<![\w.])\w+|\.\w+", plain[head + 1 : end].replace("->", ".")))
        for shape, a, b in statements(plain, begin, end):
            if '"' in plain[a:b]:
                continue
            if shape == "condition":
                add(shape, a, b, plain[a:b])
                if "someLane" not in plain[a:b] and "RARELY" not in plain[a:b]:
                    line = text.count("\n", 0, a) + 1
                    found.append(
                        Mutant(file, line, "guard", plain[a:b], "false", (a, b), shape)
                    )
            else:
                for inner, c, d in values_of(plain, a, b):
                    add(inner, c, d, plain[c:d])
    return found


def numbers_of(file, text):
    """Every number of a table, 1 % larger."""
    found = []
    for match in re.finditer(r"(?<![\w.])\d+\.?\d*(?:e-?\d+)?(?![\w.])", blank(text)):
        changed = operators.scaled_literal(match.group(0))
        if "." in match.group(0) and changed:
            line = text.count("\n", 0, match.start()) + 1
            found.append(Mutant(file, line, "constant", match.group(0), changed, match.span(), "number"))
    return found


def written(shape, original, mutants):
    """The text that chooses between a statement and its faults."""
    if shape == "return":
        choices = "".join(f"if (MUTANT == {m.number}) {m.changed}; " for m in mutants)
        return f"{{ {choices}{original}; }}"
    if shape == "statement":
        choices = "".join(f"if (MUTANT == {m.number}) {{ {m.changed}; }} else " for m in mutants)
        return f"{{ {choices}{{ {original}; }} }}"
    choices = "".join(f"MUTANT == {m.number} ? ({m.changed}) : " for m in mutants)
    return f"({choices}({original}))"


def with_mutants(text, mutants):
    """The file with these faults, each behind its number. Lines keep their numbers."""
    spans = {}
    for m in mutants:
        spans.setdefault(m.span, []).append(m)
    for (begin, end), group in sorted(spans.items(), reverse=True):
        shape, original = group[0].shape, group[0].original
        lead = original[: len(original) - len(original.lstrip())]
        choice = " ".join(written(shape, original.strip(), group).split("\n"))
        if shape in ("return", "statement"):
            end += 1  # its semicolon
        kept = text.count("\n", begin, end) - lead.count("\n")
        text = text[:begin] + lead + choice + "\n" * max(0, kept) + text[end:]
    return text
