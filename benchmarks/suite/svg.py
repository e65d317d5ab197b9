"""Plots as SVG text: lines over one axis, and bars."""
import html
import math

WIDTH, HEIGHT = 620, 360
LEFT, RIGHT, TOP, BOTTOM = 66, 16, 30, 46
COLOURS = ["#c0392b", "#2463a8", "#2e8b57", "#8e44ad", "#d08000", "#4a4a4a", "#008b8b", "#b0306a", "#7a5230",
           "#708090", "#556b2f"]


def _text(x, y, text, anchor="middle", size=12, extra=""):
    return (f'<text x="{x:.1f}" y="{y:.1f}" text-anchor="{anchor}" font-size="{size}" {extra}>'
            f'{html.escape(str(text))}</text>')


def _number(value):
    if value and not 1e-3 <= abs(value) < 1e5:
        return f"{value:.0e}".replace("e-0", "e-").replace("e+0", "e")
    return f"{value:g}"


class Axis:
    """Maps values to pixels."""

    def __init__(self, values, low_pixel, high_pixel, log, room_above=1.06):
        self.log, self.low_pixel, self.high_pixel = log, low_pixel, high_pixel
        if log:
            self.low, self.high = math.log10(min(values)), math.log10(max(values))
            room = max(0.05, 0.04 * (self.high - self.low))
            self.low, self.high = self.low - room, self.high + room
        else:
            self.low, self.high = 0.0, max(values) * room_above or 1.0

    def pixel(self, value):
        v = math.log10(value) if self.log else value
        return self.low_pixel + (v - self.low) / (self.high - self.low) * (self.high_pixel - self.low_pixel)

    def ticks(self):
        if not self.log:
            step = 10 ** math.floor(math.log10(self.high))
            step *= next(f for f in (0.2, 0.5, 1, 2) if self.high / (step * f) <= 6 or f == 2)
            return [i * step for i in range(int(self.high / step) + 1)]
        steps = (1, 2, 5) if self.high - self.low < 2.5 else (1,)
        decades = range(math.floor(self.low), math.ceil(self.high) + 1)
        return [f * 10.0**d for d in decades for f in steps if self.low <= math.log10(f * 10.0**d) <= self.high]


def _frame(title, x_label, y_label):
    middle, centre = (LEFT + WIDTH - RIGHT) / 2, (TOP + HEIGHT - BOTTOM) / 2
    return [f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {WIDTH} {HEIGHT}" font-family="sans-serif" '
            f'role="img">', f'<title>{html.escape(title)}</title>', _text(middle, 18, title, size=14),
            _text(middle, HEIGHT - 8, x_label),
            _text(14, centre, y_label, extra=f'transform="rotate(-90 14 {centre})"')]


def _grid(parts, x_axis, y_axis, x_ticks=True):
    for value in y_axis.ticks():
        y = y_axis.pixel(value)
        parts.append(f'<path d="M{LEFT} {y:.1f}H{WIDTH - RIGHT}" stroke="#ddd"/>')
        parts.append(_text(LEFT - 6, y + 4, _number(value), "end", 11))
    for value in x_axis.ticks() if x_ticks else []:
        x = x_axis.pixel(value)
        parts.append(f'<path d="M{x:.1f} {TOP}V{HEIGHT - BOTTOM}" stroke="#ddd"/>')
        parts.append(_text(x, HEIGHT - BOTTOM + 16, _number(value), size=11))
    parts.append(f'<rect x="{LEFT}" y="{TOP}" width="{WIDTH - RIGHT - LEFT}" height="{HEIGHT - BOTTOM - TOP}" '
                 'fill="none" stroke="#888"/>')


def _legend(parts, names, at_right):
    x = WIDTH - RIGHT - 8 if at_right else LEFT + 8
    for i, name in enumerate(names):
        y = TOP + 16 + 15 * i
        colour = COLOURS[i % len(COLOURS)]
        parts.append(_text(x, y, name, "end" if at_right else "start", 12,
                           f'fill="{colour}" stroke="white" stroke-width="3" paint-order="stroke"'))


def lines(title, x_label, y_label, series, log_x=True, log_y=True, legend_right=True):
    """series: [(name, [(x, y), ...])]; points without a positive value have no place on a logarithm."""
    series = [(name, [(x, y) for x, y in points if (x > 0 or not log_x) and (y > 0 or not log_y)])
              for name, points in series]
    points = [p for _, ps in series for p in ps]
    if not points:
        return ""
    x_axis = Axis([p[0] for p in points], LEFT, WIDTH - RIGHT, log_x)
    y_axis = Axis([p[1] for p in points], HEIGHT - BOTTOM, TOP, log_y)
    parts = _frame(title, x_label, y_label)
    _grid(parts, x_axis, y_axis)
    for i, (name, points) in enumerate(series):
        colour = COLOURS[i % len(COLOURS)]
        at = [(x_axis.pixel(x), y_axis.pixel(y)) for x, y in sorted(points)]
        path = "L".join(f"{x:.1f} {y:.1f}" for x, y in at)
        parts.append(f'<path d="M{path}" fill="none" stroke="{colour}" stroke-width="2"/>' if at else "")
        for (x, y), point in zip(at, sorted(points)):
            parts.append(f'<circle cx="{x:.1f}" cy="{y:.1f}" r="3.2" fill="{colour}">'
                         f'<title>{html.escape(name)}: {point[0]:g}, {point[1]:.4g}</title></circle>')
    _legend(parts, [name for name, _ in series], legend_right)
    return "\n".join([*parts, "</svg>"])


def bars(title, y_label, groups, names, line=None):
    """groups: [(label, [value of each name or None])]; `line`: a height worth marking."""
    values = [v for _, row in groups for v in row if v is not None]
    if not values:
        return ""
    y_axis = Axis(values + ([line] if line else []), HEIGHT - BOTTOM, TOP, False,
                  1.08 + 0.06 * len(names))  # the legend stands above the bars
    parts = _frame(title, "", y_label)
    _grid(parts, None, y_axis, x_ticks=False)
    width = (WIDTH - RIGHT - LEFT) / len(groups)
    for g, (label, row) in enumerate(groups):
        bar = 0.8 * width / len(row)
        for i, value in enumerate(row):
            if value is None:
                continue
            x, y = LEFT + g * width + 0.1 * width + i * bar, y_axis.pixel(value)
            parts.append(f'<rect x="{x:.1f}" y="{y:.1f}" width="{bar:.1f}" height="{HEIGHT - BOTTOM - y:.1f}" '
                         f'fill="{COLOURS[i % len(COLOURS)]}"><title>{html.escape(label)}, '
                         f'{html.escape(names[i])}: {value:.4g}</title></rect>')
        parts.append(_text(LEFT + (g + 0.5) * width, HEIGHT - BOTTOM + 16 + 13 * (g % 2), label, size=10))
    if line:
        y = y_axis.pixel(line)
        parts.append(f'<path d="M{LEFT} {y:.1f}H{WIDTH - RIGHT}" stroke="black" stroke-dasharray="5 4"/>')
    _legend(parts, names if len(names) > 1 else [], True)
    return "\n".join([*parts, "</svg>"])
