"""What can be wrong with an expression of C++ or OpenCL C: changed texts, one fault each."""

import re

TOKEN = re.compile(
    r"0[xX][0-9a-fA-F]+[uUlL]*|[A-Za-z_]\w*|\d+\.?\d*(?:[eE][-+]?\d+)?[fuUlL]*|\.\d+(?:[eE][-+]?\d+)?f?"
    r"|<<=|>>=|<=|>=|==|!=|&&|\|\||\+=|-=|\*=|/=|->|::|\+\+|--|<<|>>|."
)
LITERAL = re.compile(r"^(\d+\.\d*|\d*\.\d+|\d+)((?:[eE][-+]?\d+)?)([fuUlL]*)$")
COMPARISONS = {"<": "<=", "<=": "<", ">": ">=", ">=": ">", "==": "!=", "!=": "=="}
WORDS = [
    ("minR", "maxR"),
    ("min", "max"),
    ("width", "height"),
    ("crop_width", "crop_height"),
    ("crop_x", "crop_y"),
    ("window_x", "window_y"),
    ("window_width", "window_height"),
    ("film_width", "film_height"),
    ("block_x", "block_y"),
    ("material_front", "material_back"),
    ("alpha_u", "alpha_v"),
    ("edge_u", "edge_v"),
    ("axis_x", "axis_z"),
    ("step_x", "step_y"),
    ("near_clip", "far_clip"),
    ("eta", "inv_eta"),
    ("m_high", "m_low"),
    ("front", "back"),
    ("first", "second"),
    ("low", "high"),
    ("left", "right"),
    ("reflectance", "transmittance"),
    ("to_surface", "to_point"),
    ("b1", "b2"),
    ("wo", "wi"),
    ("ns", "ng"),
    ("o", "i"),
    ("sine", "cosine"),
    ("sin", "cos"),
    ("image", "reference"),
    ("variance", "moments"),
    ("ggx", "beckmann"),
    ("emission", "scattering"),
    ("vertex_normals", "vertex_uvs"),
    ("row", "column"),
    ("columns", "rows"),
]
SWAPPED = {a: b for a, b in WORDS} | {b: a for a, b in WORDS}
AXES = {"x": "y", "y": "x", "z": "x", "r": "g", "g": "b", "b": "r"}
# Calls that leave something out when one argument takes their place.
KEEP_ARGUMENT = {
    "sel": (1, 2),
    "sel3": (1, 2),
    "sel_surface": (1, 2),
    "scale3": (0,),
    "mul3": (0, 1),
    "add3": (0, 1),
    "sub3": (0,),
    "square": (0,),
    "normalize3": (0,),
    "neg3": (0,),
    "abs3": (0,),
    "absR": (0,),
    "abs": (0,),
    "sqrt_nonnegative": (0,),
    "minR": (0, 1),
    "maxR": (0, 1),
    "scaled": (0,),
}


def tokens_of(text):
    return [t for t in TOKEN.findall(text)]


def is_operand(token):
    return bool(token) and (token[-1].isalnum() or token[-1] in "_)]" or token == ".")


def neighbour(tokens, at, step):
    at += step
    while 0 <= at < len(tokens) and tokens[at].isspace():
        at += step
    return tokens[at] if 0 <= at < len(tokens) else ""


def scaled_literal(token):
    """A constant 1 % larger; a whole number one larger; None for what has no such."""
    match = LITERAL.match(token)
    if not match:
        return None
    digits, exponent, suffix = match.groups()
    if "." in digits or exponent:
        value = float(digits + exponent) * 1.01
        text = repr(value) if value else ""
        if "e" not in text and "." not in text:
            text += "."
        return text + suffix if value else None
    return str(int(digits) + 1) + suffix


def closing(tokens, at):
    """Where the bracket opened at `at` closes."""
    depth = 0
    for k in range(at, len(tokens)):
        depth += tokens[k] in ("(", "[", "{")
        depth -= tokens[k] in (")", "]", "}")
        if depth == 0:
            return k
    return None


def arguments(tokens, opening):
    """[(begin, end)] of the arguments of a call, and where it closes."""
    end = closing(tokens, opening)
    if end is None:
        return [], None
    parts, begin, depth = [], opening + 1, 0
    for k in range(opening + 1, end):
        depth += tokens[k] in ("(", "[", "{")
        depth -= tokens[k] in (")", "]", "}")
        if depth == 0 and tokens[k] == ",":
            parts.append((begin, k))
            begin = k + 1
    parts.append((begin, end))
    return parts, end


def factor_after(tokens, at):
    """End of the simple factor that begins behind `at`: a name, a call, a bracket, a number."""
    k = at + 1
    while k < len(tokens) and tokens[k].isspace():
        k += 1
    if k >= len(tokens) or not (tokens[k][0].isalnum() or tokens[k][0] in "_(."):
        return None
    while k < len(tokens):
        if tokens[k] in ("(", "["):
            end = closing(tokens, k)
            if end is None:
                return None
            k = end + 1
        elif tokens[k] in (".", "->", "::") or tokens[k][0].isalnum() or tokens[k][0] == "_":
            k += 1
        else:
            break
    return k


def is_placeholder(tokens, at):
    """Whether the R( at `at` stands in where a mask is not set, for the sake of a division.

    sel(mask, x, R(1.)) below a line or a root: what it gives is never used.
    """
    if "".join(tokens[at : at + 4]) != "R(1.)" or neighbour(tokens, at, -1) != ",":
        return False
    depth = 0
    for k in range(at - 1, 1, -1):
        depth += tokens[k] == ")"
        depth -= tokens[k] == "("
        if depth < 0:
            return tokens[k - 1] == "sel" and neighbour(tokens, k - 1, -1) in ("/", "(")
    return False


# Whole numbers, of which two are often the same.
COUNTED = re.compile(
    r"^(\d+|.*(count|index|child|depth|kind|row|column|width|height|size|samples?|reach|block|lobes|"
    r"side|steps|primitive|light|segment|longest|first|last|end|[xywh]|[ijkn]))$"
)


def can_tie(before, after, rest):
    """Whether two numbers compared may be equal in a picture: whole ones, or one that may be 0."""
    if rest.startswith(("R(0.)", "0.0", "R(.0)")) or before in ("0", "0.0"):
        return True
    return bool(COUNTED.match(before) and COUNTED.match(after)) and "." not in after


def changes(text, names):
    """[(kind, changed text)] of an expression, the same for the same text.

    names: what there is to take for another name.
    """
    tokens, found = tokens_of(text), []

    def put(kind, begin, end, replacement):
        changed = "".join(tokens[:begin]) + replacement + "".join(tokens[end:])
        if changed.strip() and changed != text:
            found.append((kind, changed))

    for i, token in enumerate(tokens):
        before, after = neighbour(tokens, i, -1), neighbour(tokens, i, 1)
        spaced = i > 0 and tokens[i - 1].isspace() and i + 1 < len(tokens) and tokens[i + 1].isspace()
        scaled = scaled_literal(token) if token[0].isdigit() or token[0] == "." else None
        if scaled and i >= 2 and is_placeholder(tokens, i - 2):
            continue
        if scaled and before not in ("<<", ">>"):
            put("constant", i, i + 1, scaled)
        elif token in ("+", "-") and is_operand(before) and spaced:
            put("sign", i, i + 1, "-" if token == "+" else "+")
        elif token == "-" and not is_operand(before) and after[:1].isalpha():
            put("sign", i, i + 1, "")
        elif token in ("+=", "-="):
            put("sign", i, i + 1, "-=" if token == "+=" else "+=")
        elif token in COMPARISONS and spaced:
            rest = "".join(tokens[i + 1 : i + 8]).strip()
            if token not in ("==", "!=") and not can_tie(before, after, rest):
                continue
            put("comparison", i, i + 1, COMPARISONS[token])
        elif (
            before in (".", "->")
            and token in AXES
            and after != "("
            and (token in "xyz" or "." + AXES[token] in names)
        ):
            put("axis", i, i + 1, AXES[token])
        elif ("." if before in (".", "->") else "") + SWAPPED.get(token, "") in names and after != "::":
            put("swapped", i, i + 1, SWAPPED[token])
        elif token == "HAS" and after == "(":
            put("guard", i, closing(tokens, i + 1) + 1, "1")
            put("guard", i, closing(tokens, i + 1) + 1, "0")
        elif re.match(r"^R$", token) and after == "(" and tokens[i + 2 : i + 3]:
            if re.match(r"^[A-Z][A-Z_]+$", tokens[i + 2]):
                end = closing(tokens, i + 1) + 1
                put("constant", i, end, "(" + "".join(tokens[i:end]) + " * R(1.01))")
        elif token in ("&&", "&") and spaced and is_operand(before):
            end = factor_after(tokens, i)
            if end is not None and (end >= len(tokens) or tokens[end] in (" ", ")", "\n")):
                put("guard", i, end, "")
        elif token == "*" and spaced and is_operand(before):
            end = factor_after(tokens, i)
            if end is not None:
                put("factor", i, end, "")
        if token in KEEP_ARGUMENT and after == "(" and before != "::":
            opening = tokens.index("(", i)
            parts, end = arguments(tokens, opening)
            for k in KEEP_ARGUMENT[token]:
                if end is not None and k < len(parts):
                    begin, stop = parts[k]
                    kind = "guard" if token.startswith("sel") else "factor"
                    put(kind, i, end + 1, "(" + "".join(tokens[begin:stop]).strip() + ")")
    return found
