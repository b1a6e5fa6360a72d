"""Whole runs of the program, each a fresh process, against the times that are wanted.

    pip install -r benches/comparison/requirements.txt
    EXPERIMENT=target/release/experiment python benches/comparison/whole_runs.py    # prints the table; --write puts it into docs/performance.md

BEFORE may name another build of the program: each task is then run by both in turn.

- *a list*: `[compare]` of a million asperities from an `.npy`, radii with a scatter of 30 %, at 50 separations and one pressure: both models, verdict,
  causes and report; the time beyond that of reading the file.
- *a map*: `[compare]` of a measured map from an `.npy` at 11 pressures, with everything that a report holds.
- the same list with `independent = true`, which adds the intervals of differences and of causes.
- *intervals and causes* of 10^5 of these asperities under 50 nm of lead and of a ceramic; the bound is three times the time on the bare flat.
- *check*: the slowest `experiment check` of the specs in experiments/.
- *cold sums*: the time of the sums within a fresh process over that of the library which has run them before, for the same list and separations.
"""

import timing  # before NumPy

import json
import os
import pathlib
import statistics
import subprocess
import sys
import tempfile

import numpy as np
import scipy.fft

# The two threads of a fresh process start on one processor now and then, which short sums notice most.
ROUNDS, SHORT = 5, 15
HEAD = """
seed = 1
[material.steel]
young = "210 GPa"
poisson = 0.3
hardness = "7.6 GPa"
[compare]
rough = "steel"
flat = "steel"
law = "zmc"
"""
LIST = '[surface.list.asperities]\nfile = "list.npy"\nnominal-area = "16.7 mm^2"\n'
FILE = '[surface.map.file]\npath = "map.npy"\npixel = "0.5 um"\n'
COATINGS = {
    "lead": '[material.lead]\nyoung = "18 GPa"\npoisson = 0.35\nhardness = "0.17 GPa"\n',
    "ceramic": '[material.ceramic]\nyoung = "400 GPa"\npoisson = 0.25\nhardness = "21 GPa"\n',
}
SEPARATIONS = "separation = { from = 4, to = 0, points = 50 }\n"


def run(program, spec, folder):
    """Wall time and timing.json of a run."""
    out = folder / "out"
    arguments = [program, "run", str(spec), "--out", str(out), "--force", "--quiet"]
    return seconds(arguments), json.loads((out / spec.stem / "timing.json").read_text())


def seconds(arguments):
    """Wall time of a process."""
    return timing.timed(lambda: subprocess.run(arguments, check=True, stdout=subprocess.DEVNULL))[0]


def medians(time, rounds=ROUNDS):
    """Medians of `time(program)` of the programs in turn."""
    rounds = [[time(program) for program in PROGRAMS] for _ in range(rounds)]
    return [statistics.median(times) for times in zip(*rounds)]


def surface(n):
    """A self-affine map, m: waves from 64 to 8 pixels, Hurst exponent 0.8, r.m.s. 50 nm."""
    q = np.hypot(np.fft.fftfreq(n)[:, None], np.fft.rfftfreq(n)[None])
    amplitude = np.where((q > 1 / 64) & (q < 1 / 8), np.maximum(q, 1e-9) ** -1.8, 0)
    noise = scipy.fft.rfft2(np.random.Generator(np.random.PCG64(1)).standard_normal((n, n)))
    z = scipy.fft.irfft2(amplitude * noise, s=(n, n))
    return np.ascontiguousarray(50e-9 * z / z.std())


def table(rows):
    head = ["| task | time [ms] | before [ms] | bound [ms] | met |", "|---|---:|---:|---:|---|"]
    return head + ["| " + " | ".join(cells) + " |" for cells in rows]


def main():
    rows = []
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)

        def spec(stem, text):
            path = folder / f"{stem}.toml"
            path.write_text(f'title = "{stem}"{HEAD}{text}')
            return path

        def add(task, times, bound=None):
            met = "" if bound is None else "met" if times[0] <= bound else "**missed**"
            number = lambda time: f"{1e3 * time:.3g}"
            rows.append([task, number(times[0]), *map(number, times[1:]), *[""] * (2 - len(times)), "" if bound is None else number(bound), met])
            print("  ".join(rows[-1]), flush=True)

        def beyond_reading(path):
            def time(program):
                wall, times = run(program, path, folder)
                return wall - times["read_s"]
            return medians(time)

        draw = np.random.Generator(np.random.PCG64(1))
        heights, radii = draw.normal(0, 48e-9, 10**6), 20e-6 * np.exp(draw.normal(0, 0.3, 10**6))
        np.save(folder / "list.npy", np.column_stack([heights, radii]))
        add("a list of 10^6 asperities, beyond reading", beyond_reading(spec("list", f'{SEPARATIONS}pressure = "1 MPa"\n{LIST}')), 0.060)
        path = spec("independent", f'{SEPARATIONS}pressure = "1 MPa"\n{LIST}independent = true\n')
        add("the same with intervals", beyond_reading(path))

        np.save(folder / "few.npy", np.column_stack([heights, radii])[: 10**5])
        few = LIST.replace("list.npy", "few.npy").replace("16.7", "1.67") + "independent = true\n"
        intervals = lambda spec: medians(lambda program: run(program, spec, folder)[1]["sampling_s"])
        bare = intervals(spec("bare", f"{SEPARATIONS}{few}"))
        for name, coating in COATINGS.items():
            path = spec(name, f'layer = {{ material = "{name}", thickness = "50 nm" }}\n{SEPARATIONS}{coating}{few}')
            add(f"intervals and causes under 50 nm of {name}", intervals(path), 3 * bare[0])

        for points, bound in ((1024, 0.25), (4096, 2.5)):
            np.save(folder / "map.npy", surface(points))
            path = spec("map", f'pressure = {{ from = "1 MPa", to = "100 MPa", points = 11 }}\n{FILE}')
            add(f"a map of {points} x {points} points", medians(lambda program: run(program, path, folder)[0]), bound)

        specs = sorted((timing.ROOT / "experiments").glob("*.toml"))
        checks = {s: medians(lambda program: seconds([program, "check", str(s)])) for s in specs}
        slowest = max(checks, key=lambda s: checks[s][0])
        add(f"the slowest check of {len(specs)} specs ({slowest.stem})", checks[slowest], 0.020)

        path = spec("sums", f'models = ["statistical", "deterministic"]\n{SEPARATIONS}{LIST}')
        cold = medians(lambda program: run(program, path, folder)[1]["deterministic_s"], SHORT)
        library = timing.ThisProgram()
        # Case 1, the first.
        [count] = library("asperities", 0, folder / "list.npy")
        separations = [4 - 4 * k / 49 for k in range(50)]
        _, density, *_ = library("sums", *separations)
        if round(density * count / 6e10) != np.count_nonzero(heights > 4 * 48e-9):
            sys.exit("the library sums over other asperities than the program")
        warm = statistics.median(library("sums", *separations)[0] for _ in range(2 * ROUNDS))
        add("cold sums over 10^6 asperities", cold, 1.15 * warm)
    timing.publish("whole-runs", table(rows) + ["", timing.machine(("NumPy", np.__version__))])


PROGRAMS = [os.environ.get("EXPERIMENT", str(timing.ROOT / "target" / "release" / "experiment"))]
PROGRAMS += [os.environ["BEFORE"]] if "BEFORE" in os.environ else []
for program in PROGRAMS:
    if not os.access(program, os.X_OK):
        sys.exit(f"{program} is no program; build it (cargo build --release) or set EXPERIMENT")
main()
