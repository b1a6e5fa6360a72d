"""The sums with numba, two threads, all separations of a block of asperities while it is in cache.

Each function returns an array with a row per separation: contacts, area elastic, elastic-plastic, plastic, load likewise,
sums of the squares of area and load.
"""

import math

import numba
import numpy as np

from zmc import HARDNESS, MODULUS, ONSET, SLOPE, TRANSITION

COLUMNS = 9
PI = math.pi


@numba.njit(inline="always")
def elastic(w, b):
    area = PI * b * w
    return area, 4.0 / 3.0 * MODULUS * w * math.sqrt(b * w)


@numba.njit(inline="always")
def elastic_plastic(w, b, u):
    x = (u - 1.0) * (1.0 / (TRANSITION - 1.0))
    area = PI * b * w * (1.0 + x * x * (3.0 - 2.0 * x))
    return area, HARDNESS * (0.4 + SLOPE * math.log(u)) * area


@numba.njit(inline="always")
def plastic(w, b):
    area = 2.0 * PI * b * w
    return area, HARDNESS * area


@numba.njit(inline="always")
def add_branches(row, heights, radii, d, start, end):
    """Adds asperities to a row: the law as published, one loop with a branch per regime."""
    count = 0
    a0 = a1 = a2 = p0 = p1 = p2 = aa = pp = 0.0
    for i in range(start, end):
        w = heights[i] - d
        if w > 0.0:
            b = radii[i]
            count += 1
            w1 = ONSET * b
            if w <= w1:
                area, load = elastic(w, b)
                a0 += area
                p0 += load
            else:
                u = w / w1
                if u < TRANSITION:
                    area, load = elastic_plastic(w, b, u)
                    a1 += area
                    p1 += load
                else:
                    area, load = plastic(w, b)
                    a2 += area
                    p2 += load
            aa += area * area
            pp += load * load
    add(row, count, a0, a1, a2, p0, p1, p2, aa, pp)


@numba.njit(inline="always")
def add_lists(row, w0, b0, w1, b1, w2, b2):
    """Adds a list of indentations and radii for each regime to a row: loops that become vector instructions, but for
    the logarithm."""
    a0 = a1 = a2 = p0 = p1 = p2 = aa = pp = 0.0
    for i in range(w0.size):
        area, load = elastic(w0[i], b0[i])
        a0 += area
        p0 += load
        aa += area * area
        pp += load * load
    for i in range(w1.size):
        area, load = elastic_plastic(w1[i], b1[i], w1[i] / (ONSET * b1[i]))
        a1 += area
        p1 += load
        aa += area * area
        pp += load * load
    for i in range(w2.size):
        area, load = plastic(w2[i], b2[i])
        a2 += area
        p2 += load
        aa += area * area
        pp += load * load
    add(row, w0.size + w1.size + w2.size, a0, a1, a2, p0, p1, p2, aa, pp)


@numba.njit(inline="always")
def add(row, count, a0, a1, a2, p0, p1, p2, aa, pp):
    row[0] += count
    row[1] += a0
    row[2] += a1
    row[3] += a2
    row[4] += p0
    row[5] += p1
    row[6] += p2
    row[7] += aa
    row[8] += pp


@numba.njit(parallel=True, fastmath=True, error_model="numpy")
def branches(heights, radii, separations, size):
    """Asperities in any order."""
    n = heights.size
    blocks = (n + size - 1) // size
    parts = np.zeros((blocks, separations.size, COLUMNS))
    for block in numba.prange(blocks):
        for s in range(separations.size):
            end = min(n, (block + 1) * size)
            add_branches(parts[block, s], heights, radii, separations[s], block * size, end)
    return parts.sum(axis=0)


@numba.njit(parallel=True, fastmath=True, error_model="numpy")
def survivors(heights, radii, separations, size):
    """Asperities in any order, from the nearest separation to the farthest: those still in contact are compacted
    without a branch, then moved into one list per regime."""
    n = heights.size
    blocks = (n + size - 1) // size
    parts = np.zeros((blocks, separations.size, COLUMNS))
    order = np.argsort(separations)
    for block in numba.prange(blocks):
        start, end = block * size, min(n, (block + 1) * size)
        z, b = heights[start:end].copy(), radii[start:end].copy()
        w_of, b_of = np.empty((3, size)), np.empty((3, size))
        w0, w1, w2 = w_of[0], w_of[1], w_of[2]
        b0, b1, b2 = b_of[0], b_of[1], b_of[2]
        touching = end - start
        for s in order:
            d = separations[s]
            kept = 0
            for i in range(touching):
                zi, bi = z[i], b[i]
                z[kept] = zi
                b[kept] = bi
                kept += zi > d
            touching = kept
            n0 = n1 = n2 = 0
            for i in range(touching):
                w, bi = z[i] - d, b[i]
                onset = ONSET * bi
                w0[n0] = w
                b0[n0] = bi
                w1[n1] = w
                b1[n1] = bi
                w2[n2] = w
                b2[n2] = bi
                is_elastic = w <= onset
                is_plastic = w >= TRANSITION * onset
                n0 += is_elastic
                n2 += is_plastic
                n1 += not (is_elastic or is_plastic)
            add_lists(parts[block, s], w0[:n0], b0[:n0], w1[:n1], b1[:n1], w2[:n2], b2[:n2])
    return parts.sum(axis=0)


@numba.njit(inline="always")
def block_of(turn, blocks):
    """The highest blocks have the most contacts: each thread takes every other one."""
    half = (blocks + 1) // 2
    return 2 * turn if turn < half else 2 * (turn - half) + 1


@numba.njit(inline="always")
def prefix(z, d):
    """The number of heights, highest first, above d."""
    low, high = 0, z.size
    if z[high - 1] > d:
        return high
    while low < high:
        middle = (low + high) // 2
        if z[middle] > d:
            low = middle + 1
        else:
            high = middle
    return low


@numba.njit(parallel=True, fastmath=True, error_model="numpy")
def sorted_branches(heights, radii, separations, size):
    """`branches` over asperities highest first: those in contact are a prefix, and neighbours are mostly in one regime,
    so that the branches are predictable."""
    n = heights.size
    blocks = (n + size - 1) // size
    parts = np.zeros((blocks, separations.size, COLUMNS))
    for turn in numba.prange(blocks):
        block = block_of(turn, blocks)
        start, end = block * size, min(n, (block + 1) * size)
        for s in range(separations.size):
            d = separations[s]
            if heights[start] <= d:
                continue
            touching = start + prefix(heights[start:end], d)
            add_branches(parts[block, s], heights, radii, d, start, touching)
    return parts.sum(axis=0)


@numba.njit(parallel=True, fastmath=True, error_model="numpy")
def sorted_extremes(heights, radii, separations, size):
    """Asperities highest first, in blocks so narrow that nearly all asperities of a block are in one regime: where the
    extremes of indentation and radius prove it, a loop without a branch adds them."""
    n = heights.size
    blocks = (n + size - 1) // size
    parts = np.zeros((blocks, separations.size, COLUMNS))
    for turn in numba.prange(blocks):
        block = block_of(turn, blocks)
        start, end = block * size, min(n, (block + 1) * size)
        z, b = heights[start:end], radii[start:end]
        smallest, largest = b.min(), b.max()
        w = np.empty(size)
        for s in range(separations.size):
            d = separations[s]
            if z[0] <= d:
                continue
            count = prefix(z, d)
            for i in range(count):
                w[i] = z[i] - d
            none, most, least = w[:0], w[0], w[count - 1]
            row = parts[block, s]
            if most <= ONSET * smallest:
                add_lists(row, w[:count], b[:count], none, none, none, none)
            elif least >= TRANSITION * (ONSET * largest):
                add_lists(row, none, none, none, none, w[:count], b[:count])
            elif least > ONSET * largest and most < TRANSITION * (ONSET * smallest):
                add_lists(row, none, none, w[:count], b[:count], none, none)
            else:
                add_branches(row, heights, radii, d, start, start + count)
    return parts.sum(axis=0)


def sort(heights, radii):
    """Highest first."""
    order = np.argsort(heights)[::-1]
    return heights[order], radii[order]
