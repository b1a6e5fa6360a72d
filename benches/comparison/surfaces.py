"""Surfaces compared with other programs, in one run: generation (NumPy with scipy.fft, tamaas) and five-point summits (numba).

    pip install -r benches/comparison/requirements.txt
    python benches/comparison/surfaces.py            # prints a table; --write puts it into docs/performance.md

This program and the comparison programs run alternately, 15 times each (summits three times in a row), on two threads;
medians are compared. The comparison programs are tuned: half spectra generated on two threads, two FFT workers, transforms
in place; of two numba kernels, one that counts first and one that reads the map once, the faster is used.
"""

import timing  # before NumPy and numba: sets their number of threads

import numba
import numpy as np
import scipy
import scipy.fft

from timing import POOL, ROUNDS, ThisProgram, alternately


def amplitudes(n, rows=slice(None)):
    """Standard deviations of the waves of the `full` spectrum, as in benches/comparison.rs, for some rows."""
    kx = np.fft.fftfreq(n, 1 / n)[rows]
    ky = np.fft.rfftfreq(n, 1 / n)
    q2 = np.add.outer(kx * kx, ky * ky)
    amplitude = np.maximum(q2 / 64, 1)
    np.power(amplitude, -0.9, out=amplitude)
    amplitude[q2 > (n / 2) ** 2] = 0
    return amplitude


def with_scipy(n, seed):
    """A random half spectrum, made on two threads and transformed in place."""
    wave = np.empty((n, n // 2 + 1, 2))

    def draw(part):
        rows = slice(part * n // 2, (part + 1) * n // 2)
        np.random.Generator(np.random.SFC64([seed, part])).standard_normal(out=wave[rows])
        wave[rows] *= amplitudes(n, rows)[..., None]

    list(POOL.map(draw, range(2)))
    wave[0, 0] = 0
    return scipy.fft.irfft2(wave.view(complex)[..., 0], s=(n, n), workers=2, overwrite_x=True)


def with_tamaas(n, seed):
    import tamaas

    spectrum = tamaas.Isopowerlaw2D()
    spectrum.q0, spectrum.q1, spectrum.q2, spectrum.hurst = 1, 8, n // 2, 0.8
    generator = tamaas.SurfaceGeneratorFilter2D([n, n])
    generator.spectrum = spectrum
    generator.random_seed = seed + 1
    return generator.buildSurface()


@numba.njit(parallel=True)
def count_summits(z):
    n, m = z.shape
    counts = np.zeros(n, np.int64)
    for i in numba.prange(n):
        above, row, below = z[(i - 1) % n], z[i], z[(i + 1) % n]
        count = 0
        for j in range(m):
            left = row[j - 1] if j > 0 else row[m - 1]
            right = row[j + 1] if j < m - 1 else row[0]
            v = row[j]
            if v > above[j] and v > below[j] and v > left and v > right:
                count += 1
        counts[i] = count
    return counts


@numba.njit(parallel=True)
def fill_summits(z, starts, heights, curvatures):
    n, m = z.shape
    for i in numba.prange(n):
        above, row, below = z[(i - 1) % n], z[i], z[(i + 1) % n]
        k = starts[i]
        for j in range(m):
            left = row[j - 1] if j > 0 else row[m - 1]
            right = row[j + 1] if j < m - 1 else row[0]
            v = row[j]
            if v > above[j] and v > below[j] and v > left and v > right:
                heights[k] = v
                curvatures[k] = 0.5 * ((2 * v - above[j] - below[j]) + (2 * v - left - right))
                k += 1


@numba.njit(parallel=True)
def summits_by_blocks(z, blocks):
    """One reading of the map: each block of rows into an array of its own, wide enough for any map."""
    n, m = z.shape
    rows = (n + blocks - 1) // blocks
    heights = np.empty((blocks, rows * m // 2))
    curvatures = np.empty((blocks, rows * m // 2))
    counts = np.zeros(blocks, np.int64)
    for b in numba.prange(blocks):
        k = 0
        for i in range(b * rows, min(n, (b + 1) * rows)):
            above, row, below = z[(i - 1) % n], z[i], z[(i + 1) % n]
            for j in range(m):
                left = row[j - 1] if j > 0 else row[m - 1]
                right = row[j + 1] if j < m - 1 else row[0]
                v = row[j]
                if v > above[j] and v > below[j] and v > left and v > right:
                    heights[b, k] = v
                    curvatures[b, k] = 0.5 * ((2 * v - above[j] - below[j]) + (2 * v - left - right))
                    k += 1
        counts[b] = k
    return heights, curvatures, counts


def numba_two_passes(z):
    counts = count_summits(z)
    starts = np.concatenate(([0], np.cumsum(counts)))
    heights, curvatures = np.empty(starts[-1]), np.empty(starts[-1])
    fill_summits(z, starts, heights, curvatures)
    return heights, curvatures


def numba_one_pass(z):
    heights, curvatures, counts = summits_by_blocks(z, 64)
    take = lambda parts: np.concatenate([part[:count] for part, count in zip(parts, counts)])
    return take(heights), take(curvatures)


def main():
    this_program = ThisProgram()
    rows = []

    def row(what, name, mine, other, bound):
        met = "met" if mine / other <= bound else "**missed**"
        rows.append([what, name, f"{1e3 * mine:.1f}", f"{1e3 * other:.1f}", f"{mine / other:.2f}", f"{bound:g}", met])
        print("  ".join(rows[-1]), flush=True)

    for n, bounds in ((4096, (0.55, 0.2)), (8192, (0.45, None))):
        programs = [lambda k: with_scipy(n, k)] + ([lambda k: with_tamaas(n, k)] if bounds[1] else [])
        medians = alternately(lambda k: this_program(f"generate {n} full {k}")[0], programs, ROUNDS if n == 4096 else 7)
        row(f"surface of {n} x {n}", "scipy.fft, 2 workers", medians[0], medians[1], bounds[0])
        if bounds[1]:
            row(f"surface of {n} x {n}", "tamaas", medians[0], medians[2], bounds[1])
    fresh = ThisProgram()
    peak = fresh("generate 8192 full 1")[1]
    arrays = peak / (8 * 8192**2)
    print(f"peak memory at 8192 x 8192: {arrays:.2f} arrays")

    for spectrum, what in (("full", "waves to 2 pixels"), ("cut", "waves to 8 pixels")):
        n = 4096
        this_program(f"generate {n} {spectrum} 3")
        amplitude = amplitudes(n)
        if spectrum == "cut":
            k = np.fft.fftfreq(n, 1 / n)[:, None] ** 2 + np.fft.rfftfreq(n, 1 / n)[None, :] ** 2
            amplitude = np.where(k > (n / 8) ** 2, 0, np.maximum(k / (n / 32) ** 2, 1) ** -0.9)
        rng = np.random.default_rng(3)
        wave = rng.standard_normal((n, n // 2 + 1, 2)).view(complex)[..., 0] * amplitude
        z = scipy.fft.irfft2(wave, s=(n, n), workers=2)
        del wave, amplitude
        for function in (numba_two_passes, numba_one_pass):
            function(z)
        medians = alternately(
            lambda _: this_program("summits")[0],
            [lambda _: numba_two_passes(z), lambda _: numba_one_pass(z)],
            repeats=3,
        )
        row(f"summits of 4096 x 4096, {what}", "numba", medians[0], min(medians[1:]), 0.5)

    lines = timing.table(["task", "comparison program", "this program [ms]", "comparison [ms]", "ratio", "bound", ""], rows)
    versions = ("NumPy", np.__version__), ("SciPy", scipy.__version__), ("numba", numba.__version__)
    lines += ["", f"Peak memory of a surface of 8192 x 8192: {arrays:.2f} arrays of its size (bound 1.5). {timing.machine(*versions)}"]
    timing.publish("surfaces", lines)


if __name__ == "__main__":
    main()
