"""What the tests share: the repository, and the program that results are compared with."""

import csv
import os
import subprocess
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[3]


@pytest.fixture(scope="session")
def experiment():
    """The program; built where it is not there yet."""
    target = Path(os.environ.get("CARGO_TARGET_DIR", ROOT / "target"))
    subprocess.run(["cargo", "build", "--quiet", "--bin", "experiment"], cwd=ROOT, check=True)
    return target / "debug" / "experiment"


@pytest.fixture(scope="session")
def report(experiment, tmp_path_factory):
    """Runs a spec by the program and returns the folder of its report."""

    def run(spec: str, stem: str = "spec") -> Path:
        folder = tmp_path_factory.mktemp(stem)
        path = folder / f"{stem}.toml"
        path.write_text(spec)
        subprocess.run([experiment, "run", path, "--quiet", "--out", folder / "reports"], check=True)
        return folder / "reports" / stem

    return run


@pytest.fixture(scope="session")
def vectors():
    """The rows of a file of reference vectors as dictionaries."""

    def read(name: str) -> list[dict[str, str]]:
        text = (ROOT / "tests" / "reference" / f"{name}.csv").read_text()
        return list(csv.DictReader(line for line in text.splitlines() if not line.startswith("#")))

    return read
