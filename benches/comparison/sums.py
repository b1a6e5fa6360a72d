"""The sum compared with NumPy and numba, in one run.

    pip install -r benches/comparison/requirements.txt
    python benches/comparison/sums.py            # prints a table; --write puts it into docs/performance.md;
                                            # --avx2 disables AVX-512 in all programs

A million asperities of each case of Table 1, steel on steel, uncoated, 50 separations from 4 to 0 sigma: contacts, area and
load by regime and their sampling errors together, sorting included unless the table says otherwise. This program and
the comparison programs read the same array and run alternately, 15 times, three times in a row each; results that
differ by more than 1e-12 end the run. Each comparison program uses its fastest block size on this machine.
"""

import timing  # before NumPy and numba

import pathlib
import sys
import tempfile

import numba
import numpy as np

import lower_bounds
import sum_numba
import sum_numpy
from zmc import CASES, SEPARATIONS

COUNT = 1_000_000
TOLERANCE = 1e-12
SIZES = (512, 1024, 2048, 4096, 8192)
SIZES_OF_NUMPY = (32768, 65536, 131072, 262144)


def fastest(function, sizes):
    """The fastest block size of a comparison program, after compilation."""
    function(sizes[0])
    return min(sizes, key=lambda size: min(timing.timed(function, size)[0] for _ in range(5)))


def as_answer(rows, area):
    """Sums in the form that this program returns: per nominal area, with standard errors for sums of squares."""
    totals = np.stack([rows[:, 1:4].sum(axis=1), rows[:, 4:7].sum(axis=1)], axis=1)
    errors = np.sqrt(rows[:, 7:9] - totals**2 / COUNT)
    return np.concatenate([rows[:, :7], errors], axis=1) / area


def check(name, rows, expected, area):
    """Ends the run if the results of a comparison program differ from those of this program."""
    found = as_answer(rows, area)
    error = np.abs(found - expected) / np.where(expected == 0, 1, np.abs(expected))
    if not error.max() <= TOLERANCE:
        row, column = np.unravel_index(np.nanargmax(error), error.shape)
        sys.exit(
            f"{name}: column {column} at {SEPARATIONS[row]:.3f} sigma is {found[row, column]!r}, "
            f"in this program {expected[row, column]!r}; allowed: a relative difference of {TOLERANCE}"
        )
    return error.max()


def main():
    this_program = timing.ThisProgram()
    wide = timing.has_avx512()
    rows, bounds, worst = [], [], 0.0
    root, division, other = lower_bounds.instructions()
    for case, population in enumerate(CASES):
        rng = np.random.default_rng(20050427)
        heights = population.sigma * rng.standard_normal(COUNT)
        radii = np.full(COUNT, population.radius)
        separations = np.array(SEPARATIONS) * population.sigma
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder) / "asperities.npy"
            np.save(path, np.column_stack([heights, radii]))
            this_program("asperities", case, path)

        ordered = sum_numba.sort(heights, radii)
        size_of = {}
        for kernel, arrays in (
            (sum_numba.branches, (heights, radii)),
            (sum_numba.survivors, (heights, radii)),
            (sum_numba.sorted_branches, ordered),
            (sum_numba.sorted_extremes, ordered),
        ):
            size_of[kernel] = fastest(lambda size: kernel(*arrays, separations, size), SIZES)
        tuned = {size: sum_numpy.Tuned(size) for size in SIZES_OF_NUMPY}
        best = fastest(lambda size: tuned[size](heights, radii, separations), SIZES_OF_NUMPY)

        def with_numba(kernel, arrays=None):
            size = size_of[kernel]
            return lambda _: kernel(*(arrays or (heights, radii)), separations, size)

        def sorted_first(_):
            arrays = sum_numba.sort(heights, radii)
            return sum_numba.sorted_extremes(*arrays, separations, size_of[sum_numba.sorted_extremes])

        # Each with the bound of its ratio on a machine with AVX-512; variants optimised beyond the law as published
        # are shown without one.
        programs = [
            ("numba, unsorted", with_numba(sum_numba.branches), 8),
            ("numba, unsorted, one list per regime", with_numba(sum_numba.survivors), None),
            ("numba, presorted", with_numba(sum_numba.sorted_branches, ordered), 2),
            ("numba, presorted, blocks of one regime", with_numba(sum_numba.sorted_extremes, ordered), None),
            ("numba, the same, sorting included", sorted_first, None),
            ("NumPy, tuned", lambda _: tuned[best](heights, radii, separations), 14),
        ]
        select = ("NumPy, np.select", lambda _: sum_numpy.with_select(heights, radii, separations), 300)

        task = ("sums", *SEPARATIONS)
        figures = np.array(this_program(*task)[1:]).reshape(len(SEPARATIONS), -1)
        area = COUNT / population.density
        for name, program, _ in (*programs, select):
            worst = max(worst, check(f"{population.name}, {name}", program(0), figures, area))

        own_seconds = lambda _: this_program(*task)[0]
        mine, *others = timing.alternately(own_seconds, [program for _, program, _ in programs], repeats=3)
        slow = timing.alternately(own_seconds, [select[1]])
        for (name, _, bound), seconds in zip((*programs, select), (*others, slow[1])):
            own = slow[0] if name == select[0] else mine
            ratio = seconds / own
            bound = bound if bound is None or wide else bound / 2
            met = "" if bound is None else "met" if ratio >= bound else "**missed**"
            limit = "" if bound is None else f"{bound:g}"
            cells = [f"{1e3 * own:.1f}", f"{1e3 * seconds:.1f}", f"{ratio:.1f}", limit, met]
            rows.append([population.name, name, *cells])
            print("  ".join(rows[-1]), flush=True)

        counts = lower_bounds.contacts(heights, radii, separations)
        warm, cold = lower_bounds.reading(heights, radii)
        instructions = lower_bounds.arithmetic(counts, root, other)
        for what, seconds in (
            ("16 MB read, from the caches where they hold it", warm),
            ("16 MB read, from memory", cold),
            ("a square root for each elastic contact", counts[0] * root / timing.THREADS),
            ("all instructions of the contacts", instructions),
        ):
            cells = [f"{1e3 * mine:.1f}", f"{1e3 * seconds:.2f}", f"{mine / seconds:.1f}", ""]
            bounds.append([population.name, what, *cells])
        bounds[-1][-1] = f"{counts[0]} elastic, {counts[1]} elastic-plastic, {counts[2]} plastic contacts"

    lines = timing.table(["task", "comparison program", "this program [ms]", "comparison [ms]", "ratio", "bound", "met"], rows)
    lines += ["", f"The results of all programs agree within {worst:.1e} (relative). "
              + timing.machine(("NumPy", np.__version__), ("numba", numba.__version__)), ""]
    lines += timing.table(["task", "lower bound", "this program [ms]", "lower bound [ms]", "ratio", "contacts"], bounds)
    lines += ["", f"Vectorised, on one thread, a square root takes {1e9 * root:.3f} ns per number, a division {1e9 * division:.3f} ns, "
              f"a multiply-add {1e9 * other:.3f} ns."]
    timing.publish("sums", lines)


if __name__ == "__main__":
    main()
