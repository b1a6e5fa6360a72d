"""The sum compared with NumPy and numba, in one run.

    pip install -r benches/peers/requirements.txt
    python benches/peers/sums.py            # prints a table; --write puts it into docs/performance.md;
                                            # --avx2 disables AVX-512 in all programs

A million asperities of each case of Table 1, steel on steel, uncoated, 50 separations from 4 to 0 sigma: contacts, area and
load by regime and their sampling errors together, sorting included unless the table says otherwise. This program and
the comparison programs read the same array and run alternately, 15 times, three times in a row each; results that
differ by more than 1e-12 end the run. Each comparison program uses its fastest block size on this machine.
"""

import beside  # before NumPy and numba

import pathlib
import sys
import tempfile

import numba
import numpy as np

import floor
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
    return min(sizes, key=lambda size: min(beside.timed(function, size)[0] for _ in range(5)))


def as_ours(rows, area):
    """Sums in the form that this program returns: per nominal area, with standard errors for sums of squares."""
    totals = np.stack([rows[:, 1:4].sum(axis=1), rows[:, 4:7].sum(axis=1)], axis=1)
    errors = np.sqrt(rows[:, 7:9] - totals**2 / COUNT)
    return np.concatenate([rows[:, :7], errors], axis=1) / area


def check(name, rows, ours, area):
    """Ends the run if the results of a comparison program differ from those of this program."""
    theirs = as_ours(rows, area)
    error = np.abs(theirs - ours) / np.where(ours == 0, 1, np.abs(ours))
    if not error.max() <= TOLERANCE:
        row, column = np.unravel_index(np.nanargmax(error), error.shape)
        sys.exit(
            f"{name}: column {column} at {SEPARATIONS[row]:.3f} sigma is {theirs[row, column]!r}, "
            f"ours {ours[row, column]!r}; allowed: a difference of {TOLERANCE}"
        )
    return error.max()


def main():
    ours = beside.Ours()
    wide = beside.has_avx512()
    rows, floors, worst = [], [], 0.0
    root, division, other = floor.instructions()
    for case, population in enumerate(CASES):
        rng = np.random.default_rng(20050427)
        heights = population.sigma * rng.standard_normal(COUNT)
        radii = np.full(COUNT, population.radius)
        separations = np.array(SEPARATIONS) * population.sigma
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder) / "asperities.npy"
            np.save(path, np.column_stack([heights, radii]))
            ours("asperities", case, path)

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
        peers = [
            ("numba, unsorted", with_numba(sum_numba.branches), 8),
            ("numba, unsorted, a list a regime", with_numba(sum_numba.survivors), None),
            ("numba, sorted before", with_numba(sum_numba.sorted_branches, ordered), 2),
            ("numba, sorted before, blocks of one regime", with_numba(sum_numba.sorted_extremes, ordered), None),
            ("numba, the same with its sort", sorted_first, None),
            ("NumPy, tuned", lambda _: tuned[best](heights, radii, separations), 14),
        ]
        select = ("NumPy, np.select", lambda _: sum_numpy.with_select(heights, radii, separations), 300)

        task = ("sums", *SEPARATIONS)
        figures = np.array(ours(*task)[1:]).reshape(len(SEPARATIONS), -1)
        area = COUNT / population.density
        for name, peer, _ in (*peers, select):
            worst = max(worst, check(f"{population.name}, {name}", peer(0), figures, area))

        mine, *theirs = beside.alternately(lambda _: ours(*task)[0], [peer for _, peer, _ in peers], repeats=3)
        slow = beside.alternately(lambda _: ours(*task)[0], [select[1]])
        for (name, _, bound), seconds in zip((*peers, select), (*theirs, slow[1])):
            own = slow[0] if name == select[0] else mine
            ratio = seconds / own
            bound = bound if bound is None or wide else bound / 2
            met = "" if bound is None else "met" if ratio >= bound else "**missed**"
            limit = "" if bound is None else f"{bound:g}"
            cells = [f"{1e3 * own:.1f}", f"{1e3 * seconds:.1f}", f"{ratio:.1f}", limit, met]
            rows.append([population.name, name, *cells])
            print("  ".join(rows[-1]), flush=True)

        counts = floor.contacts(heights, radii, separations)
        warm, cold = floor.reading(heights, radii)
        instructions = floor.arithmetic(counts, root, other)
        for what, seconds in (
            ("16 MB read, from the caches where they hold it", warm),
            ("16 MB read, from memory", cold),
            ("a square root for each elastic contact", counts[0] * root / beside.THREADS),
            ("all instructions of the contacts", instructions),
        ):
            cells = [f"{1e3 * mine:.1f}", f"{1e3 * seconds:.2f}", f"{mine / seconds:.1f}", ""]
            floors.append([population.name, what, *cells])
        floors[-1][-1] = f"{counts[0]} elastic, {counts[1]} elastic-plastic, {counts[2]} plastic contacts"

    lines = beside.table(["task", "peer", "ours [ms]", "peer [ms]", "ratio", "bound", "met"], rows)
    lines += ["", f"The peers' figures are ours to {worst:.1e}. "
              + beside.machine(("NumPy", np.__version__), ("numba", numba.__version__)), ""]
    lines += beside.table(["task", "floor", "ours [ms]", "floor [ms]", "times the floor", "contacts"], floors)
    lines += ["", f"In vectors a square root takes one thread {1e9 * root:.3f} ns a number, a division {1e9 * division:.3f} ns, "
              f"a multiply-add {1e9 * other:.3f} ns."]
    beside.publish("sums", lines)


if __name__ == "__main__":
    main()
