"""Mean square error against time as bias^2 + V / t."""
import math


def mean_square_fit(points):
    """points: [(seconds, mean square error, runs)]. Weighted least squares, each point by its relative error.

    A mean square of n runs is taken as known to sqrt(2 / n) of itself at best; the interval is 2 standard errors."""
    rows = [(1.0, 1.0 / t, m, m * math.sqrt(2.0 / n)) for t, m, n in points if t > 0 and m > 0]
    if len(rows) < 2:
        return None
    saa = sum((a / s) ** 2 for a, _, _, s in rows)
    sab = sum(a * b / s**2 for a, b, _, s in rows)
    sbb = sum((b / s) ** 2 for _, b, _, s in rows)
    sam = sum(a * m / s**2 for a, _, m, s in rows)
    sbm = sum(b * m / s**2 for _, b, m, s in rows)
    determinant = saa * sbb - sab**2
    if determinant <= 0:
        return None
    bias_squared, variance = (sbb * sam - sab * sbm) / determinant, (saa * sbm - sab * sam) / determinant
    if variance <= 0:
        return None
    spread = 2 * math.sqrt(sbb / determinant)
    root = lambda x: math.sqrt(max(0.0, x))  # noqa: E731
    return {"bias": root(bias_squared), "bias_low": root(bias_squared - spread), "bias_high": root(bias_squared + spread),
            "variance_seconds": variance}
