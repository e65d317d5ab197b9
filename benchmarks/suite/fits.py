"""Straight lines through logarithms, and middles."""
import math
import statistics


def power_fit(xs, ys):
    """(exponent, factor) of y = factor x^exponent, least squares in the logarithms."""
    lx, ly = [math.log(x) for x in xs], [math.log(y) for y in ys]
    mx, my = statistics.fmean(lx), statistics.fmean(ly)
    spread = sum((x - mx) ** 2 for x in lx)
    exponent = sum((x - mx) * (y - my) for x, y in zip(lx, ly)) / spread
    return exponent, math.exp(my - exponent * mx)


def value_at(xs, ys, x):
    """y at x on the polyline through the points in log-log; the end segments go on outside."""
    points = sorted(zip(xs, ys))
    i = max(1, min(len(points) - 1, sum(1 for p in points if p[0] < x)))
    (x0, y0), (x1, y1) = points[i - 1], points[i]
    share = math.log(x / x0) / math.log(x1 / x0)
    return y0 * (y1 / y0) ** share


def median(values):
    return statistics.median(values)


def root_mean_square(values):
    return math.sqrt(statistics.fmean(v * v for v in values))
