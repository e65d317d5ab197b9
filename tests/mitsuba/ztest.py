"""Statistics of the comparison: are two sets of renders of one image equal in expectation?"""

import math

import numpy as np

# Float sums of a few thousand samples differ in the last digits even without any noise. This
# relative difference is counted as one standard error, per pixel and in the mean.
ROUNDING = 1e-5

# Probability of a false alarm for a whole image, shared over its values by Sidak's rule.
ALPHA = 0.01
PIXELS_ALLOWED = 0.0025  # share of single values that may fail, as in Mitsuba's own render tests
# Smallest p-value of a channel's mean that passes (there are some 200 channels in all).
MEAN_ALPHA = 0.001
# Smallest variance of one sample that is believed: a pixel that few samples touch (the tail of a
# filter) may show none in any seed. The value is that of Mitsuba's own render tests.
VARIANCE_FLOOR = 1e-4
TILE = 8  # pixels; the tiles' test has no such allowance and finds small local differences


def students_t_two_sided(t, df):
    """P(|T| > t) of Student's distribution, by the incomplete beta function."""
    t, df = np.broadcast_arrays(np.asarray(t, float), np.asarray(df, float))
    x = df / (df + t * t)
    return incomplete_beta(df / 2, 0.5, x)


def incomplete_beta(a, b, x):
    """Regularised I_x(a, b) for arrays a and x and a number b."""
    front = np.vectorize(lambda p: math.lgamma(p + b) - math.lgamma(p) - math.lgamma(b))(a)
    with np.errstate(divide="ignore", invalid="ignore"):
        front = np.exp(front + a * np.log(x) + b * np.log1p(-x))
    swap = x > (a + 1) / (a + b + 2)
    p, q = np.where(swap, b, a), np.where(swap, a, b)
    y = np.where(swap, 1 - x, x)
    value = front * continued_fraction(p, q, y) / p
    return np.clip(np.where(swap, 1 - value, value), 0, 1)


def continued_fraction(a, b, x, terms=300):
    tiny = 1e-300
    c, d = np.ones_like(x), 1 - (a + b) * x / (a + 1)
    d = 1 / np.where(np.abs(d) < tiny, tiny, d)
    h = d.copy()
    for m in range(1, terms):
        for numerator in (
            m * (b - m) * x / ((a + 2 * m - 1) * (a + 2 * m)),
            -(a + m) * (a + b + m) * x / ((a + 2 * m) * (a + 2 * m + 1)),
        ):
            d = 1 + numerator * d
            d = 1 / np.where(np.abs(d) < tiny, tiny, d)
            c = 1 + numerator / c
            c = np.where(np.abs(c) < tiny, tiny, c)
            h = h * d * c
        if np.all(np.abs(d * c - 1) < 1e-13):
            break
    return h


def welch(a, b, floor=0.0):
    """Welch's test of stacks a and b (first axis: independent renders).

    floor: smallest variance of the difference of the means that is believed.
    Returns difference of the means, its standard error, p-value.
    """
    mean_a, mean_b = a.mean(0), b.mean(0)
    var_a, var_b = a.var(0, ddof=1) / len(a), b.var(0, ddof=1) / len(b)
    rounding = (ROUNDING * np.maximum(np.abs(mean_a), np.abs(mean_b))) ** 2
    error = np.sqrt(np.maximum(var_a + var_b, floor) + rounding)
    with np.errstate(divide="ignore", invalid="ignore"):
        df = (var_a + var_b + rounding) ** 2 / (var_a**2 / (len(a) - 1) + var_b**2 / (len(b) - 1))
        t = np.abs(mean_b - mean_a) / error
    df = np.where(np.isfinite(df), np.minimum(df, 1e6), 1e6)
    t = np.where(error > 0, t, np.where(mean_a == mean_b, 0, np.inf))
    p = np.where(np.isfinite(t), students_t_two_sided(np.where(np.isfinite(t), t, 0), df), 0)
    return mean_b - mean_a, error, p


def tiles(stack):
    """Means over TILE x TILE tiles of a stack (S, H, W); tiles at the far edges are smaller."""
    rows = np.arange(0, stack.shape[1], TILE)
    columns = np.arange(0, stack.shape[2], TILE)
    sums = np.add.reduceat(np.add.reduceat(stack, rows, 1), columns, 2)
    ones = np.ones((1,) + stack.shape[1:])
    return sums / np.add.reduceat(np.add.reduceat(ones, rows, 1), columns, 2)


def sidak(values):
    return 1 - (1 - ALPHA) ** (1 / values)


def compare_channel(reference, image, samples):
    """Tests one channel, stacks (S, H, W) in double; the key "pass" holds the verdict.

    samples: samples a pixel in all, of the reference and of the image.
    """
    finite = np.isfinite(image).all() and np.isfinite(reference).all()
    if not finite:
        return {"pass": False, "non_finite": int(np.count_nonzero(~np.isfinite(image)))}
    floor = VARIANCE_FLOOR * sum(1 / n for n in samples)
    difference, error, p = welch(reference, image, floor)
    failing = p < sidak(p.size)
    with np.errstate(divide="ignore", invalid="ignore"):
        z = np.where(error > 0, difference / error, 0)
    tile_p = welch(tiles(reference), tiles(image), floor / TILE**2)[2]
    tiles_failing = int(np.count_nonzero(tile_p < sidak(tile_p.size)))
    mean_difference, mean_error, mean_p = welch(reference.mean((1, 2)), image.mean((1, 2)))
    scale = abs(reference.mean()) or 1.0
    worst = np.unravel_index(np.argmin(p), p.shape)
    return {
        "pass": bool(
            failing.mean() <= PIXELS_ALLOWED and tiles_failing == 0 and mean_p >= MEAN_ALPHA
        ),
        "reference_mean": float(reference.mean()),
        "image_mean": float(image.mean()),
        "relative_difference_of_means": float(mean_difference / scale),
        "its_95_percent_half_interval": float(2.1 * mean_error / scale),
        "p_of_mean": float(mean_p),
        "pixels_failing": int(failing.sum()),
        "pixels": int(p.size),
        "tiles_failing": tiles_failing,
        "tiles": int(tile_p.size),
        "rms_z": float(np.sqrt(np.mean(z**2))),
        "largest_difference": float(np.abs(difference).max()),
        "worst_pixel": {
            "x": int(worst[1]),
            "y": int(worst[0]),
            "p": float(p[worst]),
            "reference": float(reference.mean(0)[worst]),
            "image": float(image.mean(0)[worst]),
        },
    }


def compare_images(reference, image, samples):
    """Both: channel name -> stack (S, H, W). A channel that only one of them has is a failure."""
    result = {}
    for name in sorted(set(reference) | set(image)):
        if name not in image or name not in reference:
            result[name] = {
                "pass": False,
                "missing_in": "image" if name not in image else "reference",
            }
        elif reference[name].shape[1:] != image[name].shape[1:]:
            result[name] = {
                "pass": False,
                "sizes": [reference[name].shape[1:], image[name].shape[1:]],
            }
        else:
            result[name] = compare_channel(reference[name], image[name], samples)
    return result
