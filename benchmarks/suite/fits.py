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


def time_at(points, error):
    """Seconds to an error on the polyline through [(seconds, error)] in log-log; outside it, from its nearer end on
    with the slope of all points.

    Only points better than all before count. None where fewer than two are left."""
    falling = []
    for seconds, e in sorted(points):
        if seconds > 0 and e > 0 and (not falling or e < falling[-1][1]):
            falling.append((seconds, e))
    if len(falling) < 2:
        return None
    if not falling[-1][1] <= error <= falling[0][1]:
        end = falling[0] if error > falling[0][1] else falling[-1]
        slope, _ = power_fit(*zip(*falling))
        return end[0] * (error / end[1]) ** (1 / slope)
    i = next(i for i in range(1, len(falling)) if falling[i][1] <= error)
    (t0, e0), (t1, e1) = falling[i - 1], falling[i]
    share = math.log(error / e0) / math.log(e1 / e0)
    return t0 * (t1 / t0) ** share


def median(values):
    return statistics.median(values)


def root_mean_square(values):
    return math.sqrt(statistics.fmean(v * v for v in values))


def standard_error(values):
    """Of the mean of at least two values."""
    return statistics.stdev(values) / math.sqrt(len(values))
