"""Shared by the scripts: the process of this program, which takes one task per line; alternating runs; and the tables of
docs/performance.md. Import it before NumPy and numba: it sets their number of threads."""

import os

THREADS = 2
for variable in ("OMP_NUM_THREADS", "NUMBA_NUM_THREADS", "RAYON_NUM_THREADS"):
    os.environ[variable] = str(THREADS)
# A dot product within a thread must not start more threads.
os.environ["OPENBLAS_NUM_THREADS"] = "1"

import sys

AVX2 = "--avx2" in sys.argv
if AVX2:
    # As on a machine without AVX-512, for all programs.
    os.environ["ASPERITY_LANES"] = "4"
    os.environ["NUMBA_CPU_NAME"], os.environ["NUMBA_CPU_FEATURES"] = "znver3", ""
    os.environ["NPY_DISABLE_CPU_FEATURES"] = "X86_V4 AVX512_ICL"

import concurrent.futures
import json
import pathlib
import statistics
import subprocess
import time

ROOT = pathlib.Path(__file__).resolve().parents[2]
ROUNDS = 15
POOL = concurrent.futures.ThreadPoolExecutor(THREADS)


class ThisProgram:
    """The release build of this program; takes one task per line."""

    def __init__(self):
        build = subprocess.run(
            ["cargo", "build", "--release", "-p", "asperity-benches", "--bin", "comparison", "--message-format=json"],
            cwd=ROOT, check=True, capture_output=True, text=True,
        )
        messages = map(json.loads, build.stdout.splitlines())
        paths = [m["executable"] for m in messages if m.get("target", {}).get("name") == "comparison"]
        self.process = subprocess.Popen([paths[-1]], stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True)

    def __call__(self, *task):
        task = " ".join(map(str, task))
        self.process.stdin.write(task + "\n")
        self.process.stdin.flush()
        answer = self.process.stdout.readline()
        try:
            return [float(word) for word in answer.split()]
        except ValueError:
            sys.exit(f"the task `{task[:80]}` got the answer `{answer.strip()[:80]}`; expected: numbers")


def timed(function, *arguments):
    start = time.perf_counter()
    result = function(*arguments)
    return time.perf_counter() - start, result


def alternately(this_program, others, rounds=ROUNDS, repeats=1):
    """Median seconds: this program, then each comparison program. The median of several `repeats` in a row
    counts, which this program makes by itself: threads just woken may share a processor for longer than a short run takes."""
    times = [[] for _ in range(1 + len(others))]
    for k in range(rounds):
        times[0].append(this_program(k))
        for seconds, program in zip(times[1:], others):
            seconds.append(statistics.median(timed(program, k)[0] for _ in range(repeats)))
    return [statistics.median(seconds) for seconds in times]


def _cpu(key):
    lines = open("/proc/cpuinfo").read().splitlines()
    return next(line.split(":")[1].strip() for line in lines if line.startswith(key))


def has_avx512():
    return not AVX2 and "avx512f" in _cpu("flags").split()


def machine(*modules):
    """A sentence on the machine, its threads, its vector instructions and the versions of the comparison programs."""
    vectors = "AVX-512" if has_avx512() else "AVX2" if "avx2" in _cpu("flags").split() else "no AVX2"
    versions = ", ".join(f"{name} {version}" for name, version in modules)
    return f"{_cpu('model name')} with {vectors}, {THREADS} threads, medians of alternate runs; {versions}."


def table(head, rows):
    """Lines of a table: the first two columns and the last aligned to the left, numbers to the right."""
    rule = "|---|---|" + "---:|" * (len(head) - 3) + "---|"
    return ["| " + " | ".join(head) + " |", rule] + ["| " + " | ".join(cells) + " |" for cells in rows]


def publish(name, lines):
    """Prints the lines; with --write, puts them into docs/performance.md between the markers of that name, which has the
    suffix -avx2 with --avx2."""
    name += "-avx2" if AVX2 else ""
    text = "\n".join(lines)
    print("\n" + text)
    if "--write" in sys.argv:
        page = ROOT / "docs" / "performance.md"
        begin, end = f"<!-- {name} -->", f"<!-- /{name} -->"
        before, _, rest = page.read_text().partition(begin)
        page.write_text(f"{before}{begin}\n{text}\n{end}{rest.partition(end)[2]}")
