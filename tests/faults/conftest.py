"""Reports before and after a fault: known-good ones to compare with byte by byte, and the program in a folder of its own.

`FULL=1` runs what docs/stability.md states; without it each test is short.
"""

import hashlib
import json
import os
import pathlib
import shutil
import subprocess

import pytest

PROGRAM = os.environ.get("EXPERIMENT", "experiment")
IS_FULL = os.environ.get("FULL") == "1"

# Of the time that a run took; everything else is the same in every run of a spec.
TIMED = ("timing.json", "manifest.json")

SPEC = """\
title = "{title}"
seed = {seed}

[material.steel]
young = "210 GPa"
poisson = 0.3
hardness = "7.6 GPa"

[compare]
rough = "steel"
flat = "steel"
law = "zmc"
pressure = {{ from = "1 MPa", to = "100 MPa", points = 5 }}

[surface.a.{surface}]
{keys}
"""

POPULATION = """\
radius = "20 um"
sigma = "48 nm"
density = "6e10 /m^2"
count = 2000
"""


def spec(seed, surface="population", keys=POPULATION, title="A report"):
    """A spec that runs in a fraction of a second; its seed is in every number."""
    return SPEC.format(title=title, seed=seed, surface=surface, keys=keys)


def count(short, full):
    """A number of repetitions."""
    return full if IS_FULL else short


def start(*arguments, cwd, **options):
    """A running program."""
    options = {"stdout": subprocess.PIPE, "stderr": subprocess.PIPE, "text": True, **options}
    return subprocess.Popen([PROGRAM, *map(str, arguments)], cwd=cwd, **options)


class Ended:
    """A program that has ended: exit code and what it said."""

    def __init__(self, process, timeout=120):
        self.output, self.errors = process.communicate(timeout=timeout)
        self.code = process.returncode
        assert "panicked" not in (self.errors or ""), self.errors

    def __repr__(self):
        return f"exit code {self.code}\n{self.output}\n{self.errors}"


def run(*arguments, cwd, **options):
    """The program, ended."""
    return Ended(start(*arguments, cwd=cwd, **options))


def is_error(ended):
    """Whether it says what went wrong."""
    return any(line.startswith("error: ") for line in ended.errors.splitlines())


def fails(ended, *words, code=1):
    """The program must have ended with a code and an error, perhaps after progress and warnings, with such words."""
    assert ended.code == code and is_error(ended), ended
    for word in words:
        assert word in ended.errors, ended
    return ended


def content(folder):
    """The files of a folder by name, hidden ones left out."""
    return {path.name: path.read_bytes() for path in sorted(folder.iterdir()) if not path.name.startswith(".")}


def report(folder):
    """The files of a report, without times; `None` where there is none. Its manifest must agree with all of them."""
    if not folder.exists():
        return None
    files = content(folder)
    written = json.loads(files["manifest.json"])["files"]
    assert {name: hashlib.sha256(files[name]).hexdigest() for name in written} == written, folder
    assert set(files) == {*written, "manifest.json"}, folder
    return {name: files[name] for name in files if name not in TIMED}


def reports(out):
    """All reports of a folder by name, and its pages."""
    folders = {path.name: report(path) for path in out.iterdir() if path.is_dir() and not path.name.startswith(".")}
    pages = {path.name: path.read_bytes() for path in out.iterdir() if path.is_file() and not path.name.startswith(".")}
    return folders, pages


def leftovers(folder):
    """What a run that was ended left behind; the lock is a file that is always there."""
    return sorted(path.name for path in folder.iterdir() if path.name.startswith(".") and path.name != ".lock")


class Place:
    """A folder with specs, and for each spec its old and its new report as they are without a fault."""

    def __init__(self, folder, names=("a",)):
        self.folder, self.names = folder, names
        self.out = folder / "reports"
        self.known = {}
        (folder / "experiments").mkdir(parents=True)
        for version, seed in (("new", 2), ("old", 1)):
            self.edit(seed)
            place = folder / version
            assert run("--out", place, cwd=folder).code == 0
            self.known[version] = reports(place)
        self.reset()

    def edit(self, seed):
        """Writes specs of a seed."""
        for k, name in enumerate(self.names):
            (self.folder / "experiments" / f"{name}.toml").write_text(spec(10 * seed + k, title=f"Report {name}"))

    def reset(self, out=None):
        """Puts old reports in place, below specs of new ones."""
        out = out or self.out
        shutil.rmtree(out, ignore_errors=True)
        shutil.copytree(self.folder / "old", out)
        self.edit(2)

    def is_whole(self, out=None):
        """Each report must be the old or the new one, each page whole; gives the number of new reports."""
        folders, pages = reports(out or self.out)
        (old, old_pages), (new, new_pages) = self.known["old"], self.known["new"]
        assert set(folders) == set(old)
        for name, files in folders.items():
            assert files in (old[name], new[name]), f"{name} is neither the old nor the new report"
        assert set(pages) == set(old_pages)
        if len(self.names) == 1:
            assert all(page in (old_pages[name], new_pages[name]) for name, page in pages.items())
        assert all(page.rstrip().endswith(old_pages[name].rstrip()[-7:]) for name, page in pages.items())
        return sum(files == new[name] for name, files in folders.items())

    def is_old(self, out=None):
        """Nothing may have changed."""
        assert reports(out or self.out) == self.known["old"]
        assert leftovers(out or self.out) == []

    def is_new_after_next_run(self, out=None):
        """The next run must work without help, and leave nothing behind."""
        out = out or self.out
        ended = run("--out", out, cwd=self.folder)
        assert ended.code == 0, ended
        assert reports(out) == self.known["new"]
        assert leftovers(out) == []


@pytest.fixture
def place(tmp_path):
    """One spec."""
    return Place(tmp_path / "place")


@pytest.fixture
def several(tmp_path):
    """Several specs that `experiment` runs together."""
    return Place(tmp_path / "several", names=("a", "b", "c"))


@pytest.fixture
def small_disk(tmp_path):
    """Mounts file systems of a given size."""
    mounted = []

    def mount(name, options):
        folder = tmp_path / name
        folder.mkdir()
        done = subprocess.run(["mount", "-t", "tmpfs", "-o", options, "tmpfs", folder], capture_output=True, text=True)
        if done.returncode:
            pytest.skip(f"a file system cannot be mounted here: {done.stderr.strip()}")
        mounted.append(folder)
        return folder

    yield mount
    for folder in mounted:
        subprocess.run(["umount", folder], check=True)
