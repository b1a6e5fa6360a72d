"""Time and memory of whole runs as the work grows: one figure and one table, up to what a machine of 8 GB holds.

    pip install -r benches/comparison/requirements.txt
    python benches/comparison/growth.py    # prints the table; --write also draws docs/growth.svg and fills docs/performance.md

Each run is a process of its own (`experiment run`): the time is that of the process, which includes reading, the models, and the report; the
memory is the largest that was resident. Slopes are d ln(time)/d ln(size) between neighbouring sizes. A series ends at the size above which `experiment
check` estimates more than 8 GB, or at the largest that is listed; the reason stands in the table.
"""

import timing  # sets the number of threads

from importlib.metadata import version
import math
import os
import pathlib
import re
import subprocess
import sys
import tempfile
import time

MEMORY = 8e9
COMMON = """
seed = 1
[material.steel]
young = "210 GPa"
poisson = 0.3
hardness = "7.6 GPa"
"""
PAIR = 'rough = "steel"\nflat = "steel"\nlaw = "zmc"\n'
POPULATION = """
[surface.set.population]
radius = "20 um"
sigma = "48 nm"
density = "6e10 /m^2"
count = {size}
"""
MAP = """
[surface.map.generate]
points = {size}
pixel = "0.5 um"
sigma = "50 nm"
spectrum.self-affine = {{ hurst = 0.8, roll-off = "{roll_off} um", cut-off = "4 um" }}
"""
SEPARATIONS = "separation = { from = 4, to = 0, points = 50 }\n"
PRESSURES = 'pressure = { from = "1 MPa", to = "100 MPa", points = 11 }\n'


class Series:
    """A kind of work at growing sizes."""

    def __init__(self, name, unit, sizes, spec):
        self.name, self.unit, self.sizes, self.spec = name, unit, sizes, spec


def population(size):
    return POPULATION.format(size=size) + "[compare]\n" + PAIR + SEPARATIONS


def tiled(size):
    return POPULATION.format(size=size) + "[tiled]\n" + PAIR + SEPARATIONS


def height_map(size):
    return MAP.format(size=size, roll_off=32) + "[compare]\n" + PAIR + PRESSURES


def reference(size):
    return MAP.format(size=size, roll_off=32) + "[compare]\n" + PAIR.replace("zmc", "hertz") + (
        'models = ["reference"]\npressure = "10 MPa"\n'
    )


def realisations(size):
    return MAP.format(size=512, roll_off=32).replace("points", f"realisations = {size}\npoints", 1) + (
        "[compare]\n" + PAIR + PRESSURES
    )


SERIES = [
    Series("asperities in memory", "asperities", [10**k for k in range(3, 10)], population),
    Series("asperities in tiles", "asperities", [10**k for k in range(6, 10)], tiled),
    Series("points of a map", "points along a side", [2**k for k in range(8, 15)], height_map),
    Series("points of the reference", "points along a side", [2**k for k in range(8, 14)], reference),
    Series("realisations of a map of 512 x 512", "realisations", [4**k for k in range(4)], realisations),
]


def run(folder, *arguments):
    """Wall time (s), processor time (s), and largest resident memory (B) of one process."""
    start = time.perf_counter()
    process = subprocess.Popen([EXPERIMENT, *arguments], cwd=folder, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)
    error = process.stderr.read()
    _, status, usage = os.wait4(process.pid, 0)
    if status != 0:
        sys.exit(f"{' '.join(arguments)} ended with {status}: {error}")
    return time.perf_counter() - start, usage.ru_utime + usage.ru_stime, 1024 * usage.ru_maxrss


def estimate(spec):
    """What `check` says that a run needs, B."""
    text = subprocess.run([EXPERIMENT, "check", spec], check=True, capture_output=True, text=True).stdout
    number, unit = re.search(r"memory: at most ([\d.]+) (.?B)", text).groups()
    return float(number) * {"kB": 1e3, "MB": 1e6, "GB": 1e9, "TB": 1e12}[unit]


def measured(series, size, folder):
    """Wall time, processor time, memory; or the reason why there are none."""
    spec = folder / "growth.toml"
    spec.write_text(f'title = "growth"{COMMON}{series.spec(size)}')
    needed = estimate(spec)
    if needed > MEMORY:
        return f"{needed / 1e9:.1f} GB needed"
    out = ["--out", str(folder / "out"), "--force", "--quiet"]
    repeats = 3 if series.sizes.index(size) < 3 else 1
    return min(run(folder, "run", str(spec), *out) for _ in range(repeats))


def two(value):
    return f"{value:.2g}" if value < 100 else f"{value:.0f}"


def rows_of(series, results):
    rows, before = [], None
    for size, found in results:
        size_text = f"{size:,}" if size < 10**6 else f"10^{round(math.log10(size))}"
        if isinstance(found, str):
            rows.append([series.name, size_text, "", "", "", "", found])
            continue
        wall, cpu, memory = found
        slope = f"{math.log(wall / before[1]) / math.log(size / before[0]):.2f}" if before else ""
        rows.append([series.name, size_text, two(wall), two(cpu), two(memory / 1e6), slope, ""])
        before = (size, wall)
    return rows


def draw(all_results, path):
    """Time and memory against the size, in two rows of panels of equal axes."""
    import matplotlib

    matplotlib.use("svg")
    matplotlib.rcParams["svg.hashsalt"] = "growth"
    matplotlib.rcParams["svg.fonttype"] = "none"
    import matplotlib.pyplot as plt

    figure, panels = plt.subplots(2, len(all_results), figsize=(3 * len(all_results), 5.4), sharex="col", sharey="row")
    for (upper, lower), (series, results) in zip(panels.T, all_results):
        points = [(size, found) for size, found in results if not isinstance(found, str)]
        sizes = [size for size, _ in points]
        for panel, place, scale in [(upper, 0, 1), (lower, 2, 1e-6)]:
            values = [scale * found[place] for _, found in points]
            panel.loglog(sizes, values, "o-", color="black", markersize=3, linewidth=0.8)
            # A line of slope 1 (2 for points along a side) through the last point.
            power = 2 if "side" in series.unit else 1
            line = [values[-1] * (size / sizes[-1]) ** power for size in sizes]
            # Work that the memory does not depend on has none.
            if values[-1] > 2 * values[0] or scale == 1:
                panel.loglog(sizes, line, "--", color="grey", linewidth=0.8)
            panel.grid(True, linewidth=0.3)
        if "side" in series.unit:
            lower.set_xticks(sizes, sizes)
            lower.xaxis.minorticks_off()
        upper.set_title(series.name, fontsize=8)
        lower.set_xlabel(series.unit, fontsize=8)
    panels[0][0].set_ylabel("time [s]", fontsize=8)
    panels[1][0].set_ylabel("largest memory [MB]", fontsize=8)
    for panel in panels.flat:
        panel.tick_params(labelsize=7)
    figure.tight_layout()
    figure.savefig(path, metadata={"Date": None})


def main():
    results = []
    with tempfile.TemporaryDirectory() as folder:
        for series in SERIES:
            found = []
            for size in series.sizes:
                found.append((size, measured(series, size, pathlib.Path(folder))))
                print(series.name, size, found[-1][1], flush=True)
                if isinstance(found[-1][1], str):
                    break
            results.append((series, found))
    head = ["work", "size", "time [s]", "processor time [s]", "largest memory [MB]", "slope of time", "ends"]
    rows = [row for series, found in results for row in rows_of(series, found)]
    timing.publish("growth", timing.table(head, rows) + ["", timing.machine(("Matplotlib", version("matplotlib"))).replace("medians of alternate runs", "least of three runs of the three smallest sizes, one of the others")])
    if "--write" in sys.argv:
        draw(results, timing.ROOT / "docs" / "growth.svg")


EXPERIMENT = os.environ.get("EXPERIMENT", str(timing.ROOT / "target" / "release" / "experiment"))
main()
