"""Lower bounds of the time of a sum: reading the asperities, and the instructions of the contacts."""

import numba
import numpy as np

from timing import THREADS, timed
from zmc import ONSET, TRANSITION

NUMBERS = 1024  # fit the first-level cache
TURNS = 200
RUNS = 200

# Minimum vector instructions of a contact, square roots and others: indentation, area, load, two sums and two
# sums of squares; elastic-plastic with a cubic and a logarithm (a polynomial of ten terms and its scaling).
INSTRUCTIONS = {"elastic": (1, 8), "elastic-plastic": (0, 24), "plastic": (0, 7)}


@numba.njit(parallel=True, fastmath=True)
def read(heights, radii, parts):
    n = heights.size
    sums = np.zeros(parts)
    for part in numba.prange(parts):
        total = 0.0
        for i in range(part * n // parts, (part + 1) * n // parts):
            total += heights[i] + radii[i]
        sums[part] = total
    return sums.sum()


@numba.njit
def square_roots(x):
    for _ in range(TURNS):
        for i in range(x.size):
            x[i] = np.sqrt(x[i])


@numba.njit(error_model="numpy")
def divisions(x):
    for _ in range(TURNS):
        for i in range(x.size):
            x[i] = 3.0 / x[i]


@numba.njit(fastmath={"contract"})
def multiply_adds(x):
    """Eight per turn and number."""
    for _ in range(TURNS):
        for i in range(x.size):
            v = x[i]
            v = v * 0.5 + 0.6
            v = v * 0.7 + 0.4
            v = v * 0.3 + 0.8
            v = v * 0.9 + 0.2
            v = v * 0.5 + 0.5
            v = v * 0.7 + 0.3
            v = v * 0.3 + 0.7
            v = v * 0.9 + 0.1
            x[i] = v


def seconds(probe, *arguments):
    """The minimum of many runs, after compilation: a lower bound."""
    probe(*arguments)
    return min(timed(probe, *arguments)[0] for _ in range(RUNS))


def reading(heights, radii):
    """Seconds in which both threads read all asperities: with the data in cache, and with other data in cache."""
    other = np.ones(8_000_000)

    def cold():
        read(other, other, THREADS)
        return timed(read, heights, radii, THREADS)[0]

    return seconds(read, heights, radii, THREADS), min(cold() for _ in range(RUNS // 4))


def instructions():
    """Seconds per number of a square root, a division and a multiply-add, in vector instructions on one thread."""
    x = np.linspace(1, 2, NUMBERS)
    probes = (square_roots, 1), (divisions, 1), (multiply_adds, 8)
    return tuple(seconds(probe, x) / (NUMBERS * TURNS * times) for probe, times in probes)


def contacts(heights, radii, separations):
    """Contacts in each regime, over all separations."""
    first = ONSET * radii
    counts = np.zeros(3, int)
    for d in separations:
        w = heights - d
        touching, yielded, plastic = (np.count_nonzero(w > above) for above in (0.0, first, TRANSITION * first))
        counts += (touching - yielded, yielded - plastic, plastic)
    return counts


def arithmetic(counts, root, other):
    """Seconds that both threads need for the instructions of the contacts."""
    each = [roots * root + others * other for roots, others in INSTRUCTIONS.values()]
    return sum(n * one for n, one in zip(counts, each)) / THREADS
