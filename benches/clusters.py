"""Cost of a tiled run from 1e6 to 1e9 asperities, on one thread and on two.

    python benches/clusters.py      # prints the tables; --write puts them into docs/clusters.md

Populations are drawn as they are summed, one law at 50 separations. Times are wall times of whole processes; each is the least of
several, taken in turns, since other work on the machine only adds to it.
"""

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

    def spec(self, name, count):
        (self.folder / f"{name}.toml").write_text(SPEC.format(count=count))
        return f"{name}.toml"

    def seconds(self, command):
        """Wall time of a command."""
        start = time.perf_counter()
        process = subprocess.Popen([self.program, *command, "--quiet"], cwd=self.folder)
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


def table(head, rows):
    lines = ["| " + " | ".join(head) + " |", "|" + "---:|" * len(head)]
    return lines + ["| " + " | ".join(row) + " |" for row in rows]


def costs(program):
    rows = []
    for exponent, rounds in ((6, 7), (7, 7), (8, 5), (9, 1)):
        spec = program.spec(f"n{exponent}", 10**exponent)
        (seconds,) = least(rounds, lambda: program.seconds(whole(spec, 2)))
        check = subprocess.run([program.program, "check", spec], cwd=program.folder, check=True, capture_output=True, text=True)
        tiles = re.search(r"(\d+) tiles", check.stdout)[1]
        rows.append([f"1e{exponent}", tiles, f"{seconds:.3g}", f"{2e9 * seconds / 10**exponent:.2f}"])
        print("  ".join(rows[-1]), flush=True)
    lines = table(["asperities", "tiles", "time [s]", "core time per asperity [ns]"], rows)
    return lines + ["", f"A process took at most {program.memory / 1e6:.0f} MB of memory, at any size. About 20 ms are the integral, the page and its figures."]


def scaling(program):
    spec = program.spec("one", 10**8)
    names = ["1e8, one process, one thread", "1e8, one process, two threads"]
    times = least(5, lambda: program.seconds(whole(spec, 1)), lambda: program.seconds(whole(spec, 2)))
    rows = [[name, f"{seconds:.3g}", f"{times[0] / seconds:.2f}"] for name, seconds in zip(names, times)]
    return table(["run", "time [s]", "speed over one thread"], rows)


def main():
    with tempfile.TemporaryDirectory() as folder:
        program = Program(folder)
        sections = [costs(program), scaling(program)]
    cpu = next((line.split(":")[1].strip() for line in open("/proc/cpuinfo") if line.startswith("model name")), platform.machine())
    text = "\n\n".join("\n".join(lines) for lines in sections)
    measured = f"Measured on {os.cpu_count()} cores of {cpu}."
    if "--write" not in sys.argv:
        print(text, measured, sep="\n\n")
        return
    page = PAGE.read_text()
    for name, lines in zip(("cost", "scaling"), sections):
        begin, end = f"<!-- {name} -->\n", f"<!-- /{name} -->"
        before, rest = page.split(begin)
        page = before + begin + "\n".join(lines) + "\n" + end + rest.split(end)[1]
    before, rest = page.split("<!-- machine -->")
    PAGE.write_text(before + f"<!-- machine -->{measured}<!-- /machine -->" + rest.split("<!-- /machine -->")[1])


if __name__ == "__main__":
    main()
