"""Boundary elements compared with tamaas, in one run.

    pip install -r benches/comparison/requirements.txt
    python benches/comparison/boundary_elements.py    # prints tables; --write puts them into docs/performance.md

Frictionless elastic contact of a periodic surface of 1024 x 1024 points, 8 of them per shortest wave, Hurst exponent 0.8,
E* = 1, r.m.s. gradient 1: one load at 5 % of contact area, and, once, 20 loads from 0.3 % to 12 %. tamaas (PolonskyKeerRey) keeps its
pressures from load to load; this program solves each anew. Both get the same error, and the dual gap of the pressures that they return,
sum p (g - min g) over sum p std(h), is computed here with one formula; areas that differ by more than 1e-5 end the run.
The wheel of tamaas on PyPI has one thread; no build with OpenMP is published, so that its wall time on more threads is not known.
"""

import timing  # before NumPy

import pathlib
import resource
import statistics
import sys
import tempfile
import time

import numpy as np
import scipy.fft
import tamaas

POINTS, CUT, ERROR, ROUNDS = 1024, 8, 1e-8, 3
LOAD, CURVE = 0.0203, np.geomspace(0.00111, 0.0516, 20)
SIZES = (512, 1024, 2048, 4096)
# Of the time per convolution over that of its bare transforms in double precision.
MOST = 3


def wave_numbers(n):
    return np.hypot(np.fft.fftfreq(n, 1 / n)[:, None], np.fft.rfftfreq(n, 1 / n)[None])


def surface(n, seed=1):
    """Random phases under a power law from n/16 points to CUT points, r.m.s. gradient 1."""
    q = wave_numbers(n)
    amplitude = np.maximum(q, 1) ** -1.8
    amplitude[(q < 16) | (q > n / CUT)] = 0
    noise = scipy.fft.rfft2(np.random.Generator(np.random.PCG64(seed)).standard_normal((n, n)))
    waves = amplitude * noise / np.maximum(np.abs(noise), 1e-300)
    power = np.abs(waves / n**2) ** 2
    power[:, 1 : (n + 1) // 2] *= 2
    return np.ascontiguousarray(scipy.fft.irfft2(waves, s=(n, n)) / (2 * np.pi * np.sqrt((power * q**2).sum())))


def dual_gap(h, p):
    q = 2 * np.pi * wave_numbers(len(h))
    kernel = np.divide(2.0, q, out=np.zeros_like(q), where=q > 0)
    g = scipy.fft.irfft2(scipy.fft.rfft2(p) * kernel, s=h.shape) - h
    return (p * (g - g.min())).sum() / (p.sum() * h.std())


def with_tamaas(h, loads):
    """Wall and CPU seconds, the area at each load, and the last pressures."""
    usage = lambda: sum(resource.getrusage(resource.RUSAGE_SELF)[:2])
    start, cpu = time.perf_counter(), usage()
    model = tamaas.Model(tamaas.model_type.basic_2d, [1.0, 1.0], list(h.shape))
    model.E, model.nu = 1.0, 0.0
    solver = tamaas.PolonskyKeerRey(model, h, ERROR)
    solver.max_iter = 20_000
    areas = []
    for load in loads:
        solver.solve(float(load))
        areas.append((np.asarray(model.traction) > 0).mean())
    return time.perf_counter() - start, usage() - cpu, areas, np.array(model.traction)


def main():
    tamaas.set_log_level(tamaas.LogLevel.error)
    this_program = timing.ThisProgram()
    rows, growth = [], []
    with tempfile.TemporaryDirectory() as folder:
        path, out = pathlib.Path(folder) / "map.npy", pathlib.Path(folder) / "pressures.npy"
        h = surface(POINTS)
        np.save(path, h)
        this_program("map", path)
        for name, loads, rounds, bound in (("5 % area", [LOAD], ROUNDS, 30), ("20 loads, 0.3 to 12 % area", CURVE, 1, 20)):
            times = {"own": [], "tamaas": []}
            for _ in range(rounds):
                wall, cpu, *found = this_program("contacts", out, ERROR, *loads)
                own = np.load(out)
                times["own"].append((wall, cpu))
                wall, cpu, areas, pressures = with_tamaas(h, loads)
                times["tamaas"].append((wall, cpu))
            apart = np.abs(np.array(areas) - found[0::3]).max()
            if not apart <= 1e-5:
                sys.exit(f"{name}: the areas differ by {apart:.1e}; allowed: 1e-5")
            gaps = [dual_gap(h, p) for p in (own, pressures)]
            medians = {who: np.median(all_rounds, axis=0) for who, all_rounds in times.items()}
            for k, (what, bound) in enumerate((("wall", None), ("CPU", bound))):
                mine, theirs = medians["own"][k], medians["tamaas"][k]
                met = "" if bound is None else "met" if theirs / mine >= bound else "**missed**"
                limit = "" if bound is None else str(bound)
                rows.append([f"{name}, {what} time", "tamaas, one thread", f"{mine:.2f}", f"{theirs:.1f}", f"{theirs / mine:.1f}", limit, met])
                print("  ".join(rows[-1]), flush=True)
            print(f"areas agree within {apart:.1e}; dual gaps {gaps[0]:.1e} and {gaps[1]:.1e}", flush=True)
        for n in SIZES:
            np.save(path, surface(n))
            this_program("map", path)
            # Three runs of a small map scatter: more of them.
            rounds = ROUNDS * SIZES[-1] // n
            runs = [this_program("contacts", out, ERROR, LOAD) for _ in range(rounds)]
            wall, cpu = (statistics.median(run[k] for run in runs) for k in (0, 1))
            area, steps, convolutions = runs[0][2:]
            bare = statistics.median(this_program("transforms", n)[0] for _ in range(rounds))
            ratio = wall / convolutions / bare
            growth.append([f"{n} x {n}", f"{100 * area:.1f} %", f"{wall:.2f}", f"{cpu:.2f}", f"{steps:.0f}", f"{convolutions:.0f}",
                           f"{1e3 * wall / convolutions:.1f}", f"{1e3 * bare:.1f}", f"{ratio:.1f}", f"{MOST}",
                           "met" if ratio <= MOST else "**missed**"])
            print("  ".join(growth[-1]), flush=True)
    lines = timing.table(["task", "comparison program", "this program [s]", "comparison [s]", "ratio", "bound", "met"], rows)
    lines += ["", f"Dual gap {ERROR:g}. " + timing.machine(("NumPy", np.__version__), ("tamaas", tamaas.__version__)), ""]
    lines += timing.table(["points", "area", "wall [s]", "CPU [s]", "steps", "convolutions", "wall per convolution [ms]",
                           "bare transforms [ms]", "ratio", "bound", "met"], growth)
    timing.publish("boundary-elements", lines)


if __name__ == "__main__":
    main()
