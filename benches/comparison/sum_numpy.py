"""The sums with NumPy: in the simplest form, and tuned for two threads. Returns the same arrays as `sum_numba`."""

import math
import threading

import numpy as np

from timing import POOL
from zmc import HARDNESS, MODULUS, ONSET, SLOPE, TRANSITION

COLUMNS = 9


def with_select(heights, radii, separations):
    """np.select over all asperities."""
    return np.array([select(heights, radii, d) for d in separations])


def select(heights, radii, d):
    w = heights - d
    w1 = ONSET * radii
    u = w / w1
    x = (u - 1) / (TRANSITION - 1)
    with np.errstate(invalid="ignore", divide="ignore"):
        regimes = [w <= 0, w <= w1, u < TRANSITION]
        area = np.select(regimes, [0, 1, 1 + x * x * (3 - 2 * x)], 2) * (math.pi * radii * w)
        hertz = 4 / 3 * MODULUS * np.sqrt(radii) * w**1.5
        load = np.select(regimes, [0, hertz, HARDNESS * (0.4 + SLOPE * np.log(u)) * area], HARDNESS * area)
    regime = np.select(regimes, [-1, 0, 1], 2)
    by_regime = [quantity[regime == k].sum() for quantity in (area, load) for k in range(3)]
    return [np.count_nonzero(w > 0), *by_regime, (area * area).sum(), (load * load).sum()]


class Tuned:
    """Blocks that stay in cache, each ordered once, so that the asperities in contact are a slice, and those that have
    yielded lie within a slice of it; arrays are allocated once per thread and every operation is in place."""

    def __init__(self, size):
        self.size = size
        self.of_thread = threading.local()

    def __call__(self, heights, radii, separations):
        def block(start):
            return self.block(heights[start : start + self.size], radii[start : start + self.size], separations)

        return sum(POOL.map(block, range(0, heights.size, self.size)))

    def block(self, z, b, separations):
        if not hasattr(self.of_thread, "arrays"):
            self.of_thread.arrays = np.empty((6, self.size))
            self.of_thread.masks = np.empty((2, self.size), bool)
        order = np.argsort(-z)
        z, b = z[order], b[order]
        counts = np.searchsorted(-z, -separations)
        inverse, disc, hertz = 1 / (ONSET * b), math.pi * b, 4 / 3 * MODULUS * np.sqrt(b)
        rows = np.zeros((len(separations), COLUMNS))
        for row, d, n in zip(rows, separations, counts):
            if n == 0:
                continue
            w, u, area, load, spare, x = self.of_thread.arrays[:, :n]
            np.subtract(z[:n], d, out=w)
            np.multiply(w, inverse[:n], out=u)
            np.multiply(w, disc[:n], out=area)
            yielded = np.greater(u, 1, out=self.of_thread.masks[0, :n])
            m = n - int(yielded[::-1].argmax()) if yielded.any() else 0
            # Only where all of the first m have yielded is Hertz for the others alone.
            rest = m if yielded[:m].all() else 0
            np.sqrt(w[rest:], out=load[rest:])
            load[rest:] *= w[rest:]
            load[rest:] *= hertz[rest:n]
            row[0] = n
            if m:
                u, x, spare = u[:m], x[:m], spare[:m]
                # Growth of the area ends at 2, mean pressure at H.
                np.clip(u, 1, TRANSITION, out=u)
                np.multiply(u, -2 / (TRANSITION - 1), out=spare)
                spare += 3 + 2 / (TRANSITION - 1)
                np.subtract(u, 1, out=x)
                x *= 1 / (TRANSITION - 1)
                spare *= x
                spare *= x
                spare += 1
                area[:m] *= spare
                np.log(u, out=x)
                x *= HARDNESS * SLOPE
                x += HARDNESS * 0.4
                x *= area[:m]
                np.copyto(load[:m], x, where=True if rest else yielded[:m])
            plastic = np.greater_equal(u[:m], TRANSITION, out=self.of_thread.masks[1, :m])
            p = np.count_nonzero(plastic)
            if rest == m and plastic[:p].all():
                slices = slice(m, n), slice(p, m), slice(p)
                row[1:7] = [quantity[part].sum() for quantity in (area, load) for part in slices]
            else:
                masks = ~yielded, yielded.copy(), np.zeros(n, bool)
                masks[1][:m] &= ~plastic
                masks[2][:m] = plastic
                row[1:7] = [np.dot(quantity, mask) for quantity in (area, load) for mask in masks]
            row[7], row[8] = np.dot(area, area), np.dot(load, load)
        return rows
