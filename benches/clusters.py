"""Cost of a tiled run from 1e6 to 1e9 asperities, of its parts and their merge, and what 1e11 on 100 nodes would take.

    python benches/clusters.py      # prints the tables; --write puts them into docs/clusters.md

Populations are drawn as they are summed, one law at 50 separations. Times are wall times of whole processes; each is the least of
several, taken in turns, since other work on the machine only adds to it.
"""

import json
import os
import pathlib
import platform
import re
import subprocess
import sys
import tempfile
import time

ROOT = pathlib.Path(__file__).resolve().parents[1]
PAGE = ROOT / "docs" / "clusters.md"
SPEC = """title = "population"
seed = 1

[material.steel]
young = "210 GPa"
poisson = 0.3
hardness = "7.6 GPa"

[surface.S.population]
radius = "20 um"
sigma = "48 nm"
density = "6e10 /m^2"
count = {count}
realisations = {realisations}

[tiled]
rough = "steel"
flat = "steel"
law = "zmc"
separation = {{ from = 4, to = 0, points = 50 }}
"""


class Program:
    """The release build, run in a folder of its own."""

    def __init__(self, folder):
        subprocess.run(["cargo", "build", "--release", "--bin", "experiment"], cwd=ROOT, check=True)
        target = pathlib.Path(os.environ.get("CARGO_TARGET_DIR", ROOT / "target"))
        self.memory = 0
        self.program, self.folder = target / "release" / "experiment", pathlib.Path(folder)

    def spec(self, name, count, realisations=1):
        (self.folder / f"{name}.toml").write_text(SPEC.format(count=count, realisations=realisations))
        return f"{name}.toml"

    def start(self, *arguments):
        return subprocess.Popen([self.program, *arguments, "--quiet"], cwd=self.folder)

    def seconds(self, *commands):
        """Wall time of commands that run side by side."""
        for part in (self.folder / "parts").glob("*") if "--part" in commands[0] else ():
            part.unlink()
        start = time.perf_counter()
        for process in [self.start(*command) for command in commands]:
            _, status, usage = os.wait4(process.pid, 0)
            process.returncode = os.waitstatus_to_exitcode(status)
            if process.returncode:
                sys.exit("a run failed")
            self.memory = max(self.memory, usage.ru_maxrss * 1024)
        return time.perf_counter() - start


def least(rounds, *tasks):
    """The least time of each task, which run in turns."""
    times = [[] for _ in tasks]
    for _ in range(rounds):
        for task, own in zip(tasks, times):
            own.append(task())
    return [min(own) for own in times]


def whole(spec, threads):
    return ("run", spec, "--force", "--threads", str(threads))


def part(spec, index, of, threads=1):
    return ("run", spec, "--part", f"{index}/{of}", "--threads", str(threads))


def table(head, rows):
    lines = ["| " + " | ".join(head) + " |", "|" + "---:|" * len(head)]
    return lines + ["| " + " | ".join(row) + " |" for row in rows]


def costs(program):
    rows, cost = [], None
    for exponent, rounds in ((6, 7), (7, 7), (8, 5), (9, 1)):
        spec = program.spec(f"n{exponent}", 10**exponent)
        (seconds,) = least(rounds, lambda: program.seconds(whole(spec, 2)))
        check = subprocess.run([program.program, "check", spec], cwd=program.folder, check=True, capture_output=True, text=True)
        tiles = re.search(r"(\d+) tiles", check.stdout)[1]
        cost = 2 * seconds / 10**exponent
        rows.append([f"1e{exponent}", tiles, f"{seconds:.3g}", f"{1e9 * cost:.2f}"])
        print("  ".join(rows[-1]), flush=True)
    lines = table(["asperities", "tiles", "time [s]", "core time per asperity [ns]"], rows)
    return cost, lines + ["", f"A process took at most {program.memory / 1e6:.0f} MB of memory, at any size. About 20 ms are the integral, the page and its figures."]


def scaling(program):
    one, two = program.spec("one", 10**8), program.spec("two", 2 * 10**8)
    names = [
        "1e8, one process, one thread",
        "1e8, one process, two threads",
        "1e8, two parts side by side, one thread each",
        "2e8, two parts side by side, one thread each",
    ]
    tasks = [
        lambda: program.seconds(whole(one, 1)),
        lambda: program.seconds(whole(one, 2)),
        lambda: program.seconds(part(one, 1, 2), part(one, 2, 2)),
        lambda: program.seconds(part(two, 1, 2), part(two, 2, 2)),
    ]
    times = least(5, *tasks)
    speeds = [1.0, *(times[0] / seconds for seconds in times[1:3]), 2 * times[0] / times[3]]
    rows = [[name, f"{seconds:.3g}", f"{speed:.2f}"] for name, seconds, speed in zip(names, times, speeds)]
    return table(["run", "time [s]", "speed over one thread"], rows)


def overheads(program):
    """Of a part beyond its sum, and of a merge by its tiles."""
    tiny = program.spec("tiny", 1)
    (start,) = least(20, lambda: program.seconds(part(tiny, 1, 1)))
    rows, merge = [], None
    for count, realisations in ((16 * 4096 * 64, 1), (16 * 4096 * 64, 16), (16 * 4096 * 4, 1000)):
        spec = program.spec("merged", count, realisations)
        program.seconds(part(spec, 1, 1, 2))
        (file,) = (program.folder / "parts").glob("merged-*")
        tiles, size = json.loads(file.read_text())["of_tiles"], file.stat().st_size
        (seconds,) = least(5, lambda: program.seconds(("merge", spec)))
        rows.append([str(tiles), f"{size / tiles / 1000:.1f}", f"{seconds:.3f}"])
        merge = seconds / tiles, size / tiles
        file.unlink()
    lines = table(["tiles", "file per tile [kB]", "time of the merge [s]"], rows)
    return start, merge, [f"A part of a single asperity takes {1e3 * start:.0f} ms: the process, the spec, a file flushed to the disk.", "", *lines]


def model(cost, start, merge):
    """Time of 1e11 asperities on 100 nodes of 32 cores; the text of docs/clusters.md states the assumptions."""
    asperities, nodes, cores, tiles = 1e11, 100, 32, 4091
    latency, bandwidth, scatter = 0.05, 100e6, 0.05
    per_merge, size = merge
    most_tiles = -(-tiles // nodes)
    sums = most_tiles / tiles * asperities * cost / cores
    # The slowest of 100 nodes whose speeds scatter by 5 % is 2.5 standard deviations slower.
    stragglers = 2.5 * scatter * sums
    files = start + latency + nodes * (most_tiles * size) / bandwidth
    merging = tiles * per_merge + nodes * latency + tiles * size / bandwidth
    rows = [
        [f"sum of {most_tiles} of {tiles} tiles on {cores} cores", f"{sums:.3g}"],
        ["waiting for the slowest node", f"{stragglers:.2g}"],
        ["start and writing of 100 parts", f"{files:.2g}"],
        ["merge", f"{merging:.2g}"],
        ["**together**", f"**{sums + stragglers + files + merging:.2g}**"],
    ]
    return table(["", "time [s]"], rows)


def main():
    with tempfile.TemporaryDirectory() as folder:
        program = Program(folder)
        cost, lines = costs(program)
        start, merge, of_parts = overheads(program)
        sections = [lines, scaling(program), of_parts, model(cost, start, merge)]
    cpu = next((line.split(":")[1].strip() for line in open("/proc/cpuinfo") if line.startswith("model name")), platform.machine())
    text = "\n\n".join("\n".join(lines) for lines in sections)
    measured = f"Measured on {os.cpu_count()} cores of {cpu}."
    if "--write" not in sys.argv:
        print(text, measured, sep="\n\n")
        return
    page = PAGE.read_text()
    for name, lines in zip(("cost", "scaling", "parts", "model"), sections):
        begin, end = f"<!-- {name} -->\n", f"<!-- /{name} -->"
        before, rest = page.split(begin)
        page = before + begin + "\n".join(lines) + "\n" + end + rest.split(end)[1]
    before, rest = page.split("<!-- machine -->")
    PAGE.write_text(before + f"<!-- machine -->{measured}<!-- /machine -->" + rest.split("<!-- /machine -->")[1])


if __name__ == "__main__":
    main()
