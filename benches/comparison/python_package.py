"""The Python package compared with the same sum in Rust and with numba, in one run.

    pip install -r benches/comparison/requirements.txt ./crates/asperity-python
    python benches/comparison/python_package.py      # prints a table; --write puts it into docs/performance.md

A million asperities of each case of Table 1, steel on steel, uncoated, 50 separations from 4 to 0 sigma. The package computes
mean and sigma of the heights in every call; the sum in Rust is given both. All read the same arrays and run
alternately, 15 times, 15 times in a row each; loads that differ by more than 1e-12 end the run.
"""

import timing  # before NumPy and numba

import pathlib
import sys
import tempfile

import numba
import numpy as np

import asperity
import sum_numba
from zmc import CASES, SEPARATIONS

COUNT = 1_000_000
TOLERANCE = 1e-12
SIZE = 2048
CALLS = 20_000
# In a row: the first ones wake threads and fill caches.
REPEATS = 15


def main():
    this_program = timing.ThisProgram()
    steel = asperity.Material(210e9, 0.3, hardness=7.6e9)
    contact = asperity.Interface(steel, steel)
    rows = []
    for case, population in enumerate(CASES):
        rng = np.random.default_rng(20050427)
        heights = population.sigma * rng.standard_normal(COUNT)
        # Mean and sigma of the numbers themselves, so that all sum at the same separations.
        heights = (heights - heights.mean()) * (population.sigma / heights.std())
        radii = np.full(COUNT, population.radius)
        area = COUNT / population.density
        separations = np.array(SEPARATIONS)
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder) / "asperities.npy"
            np.save(path, np.column_stack([heights, radii]))
            this_program("asperities", case, path)
        held = asperity.Asperities(heights, radii, area)

        def package(_):
            return asperity.deterministic(contact, held, separations=separations)

        def constructed(_):
            return asperity.deterministic(
                contact, asperity.Asperities(heights, radii, area), separations=separations
            )

        def with_numba(_):
            return sum_numba.branches(heights, radii, separations * population.sigma, SIZE)

        loads = with_numba(0)[:, 4:7].sum(axis=1) / area
        error = np.abs(package(0)["pressure_pa"] / loads - 1).max()
        if not error <= TOLERANCE:
            sys.exit(f"{population.name}: package and numba differ by {error:.1e}; allowed: {TOLERANCE}")
        task = ("sums", *SEPARATIONS)
        rust, *others = timing.alternately(
            lambda _: this_program(*task)[0], [package, constructed, with_numba], repeats=REPEATS
        )
        for name, seconds in zip(("the package", "the package, arrays checked in each call", "numba, unsorted"), others):
            rows.append([population.name, name, f"{1e3 * rust:.1f}", f"{1e3 * seconds:.1f}", f"{seconds / rust:.2f}", ""])
            print("  ".join(rows[-1]), flush=True)
        rows[-1][-1] = f"{others[2] / others[0]:.1f} times the package"

    ten = asperity.Asperities(heights[:10].copy(), radii[:10].copy(), 1e-9)

    def calls(_):
        for _ in range(CALLS):
            asperity.deterministic(contact, ten, separations=1.0)

    seconds = min(timing.timed(calls, 0)[0] for _ in range(5)) / CALLS
    lines = timing.table(["task", "program", "sum in Rust [ms]", "time [ms]", "ratio", "note"], rows)
    lines += ["", f"A call on ten asperities at one separation takes {1e6 * seconds:.1f} us. "
              + timing.machine(("NumPy", np.__version__), ("numba", numba.__version__))]
    timing.publish("python-package", lines)


if __name__ == "__main__":
    main()
