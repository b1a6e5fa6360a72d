"""Files that change, shrink or go while a run reads them: an error that says so, never a result of two contents."""

import pathlib
import random
import shutil
import struct
import time

import pytest

from conftest import IS_FULL, Ended, count, is_error, report, run, spec, start

SIDE = 640 if IS_FULL else 320
SAMPLES = pathlib.Path(__file__).resolve().parents[2] / "crates/asperity/tests/library/formats/samples"


def npy(path, seed, side=SIDE):
    """A map of random heights, nm."""
    rng = random.Random(seed)
    row = [rng.gauss(0, 3e-8) for _ in range(4 * side + 7)]
    header = f"{{'descr': '<f8', 'fortran_order': False, 'shape': ({side}, {side}), }}"
    header += " " * (-(len(header) + 11) % 64) + "\n"
    with open(path, "wb") as file:
        file.write(b"\x93NUMPY\x01\x00" + struct.pack("<H", len(header)) + header.encode())
        for _ in range(side):
            k = rng.randrange(3 * side + 7)
            file.write(struct.pack(f"<{side}d", *row[k : k + side]))


@pytest.fixture
def measured(tmp_path):
    """A comparison on a map that is read from the disk row by row, with its report."""
    npy(tmp_path / "map.npy", 1)
    keys = 'path = "map.npy"\npixel = "1 um"\nlevel = "none"\n'
    (tmp_path / "a.toml").write_text(spec(1, "file", keys))
    assert run("run", "a.toml", cwd=tmp_path).code == 0
    return tmp_path


def forced(folder):
    """A run of a spec whose report is up to date."""
    return start("run", "a.toml", "--force", cwd=folder)


def cut(path):
    """As a program that writes it anew does."""
    path.write_bytes(path.read_bytes()[:5000])


def rewritten(path):
    """Written anew with the same content: for a moment it is empty."""
    whole = path.read_bytes()
    with open(path, "wb") as file:
        file.flush()
        time.sleep(0.02)
        file.write(whole)


def replaced(path):
    npy(path.with_name("other.npy"), 2)
    path.with_name("other.npy").rename(path)


FAULTS = {"cut": cut, "rewritten": rewritten, "replaced": replaced, "removed": pathlib.Path.unlink}


@pytest.mark.parametrize("fault", FAULTS)
def test_a_map_that_changes_while_it_is_read(measured, fault):
    path, before = measured / "map.npy", report(measured / "reports/a")
    shutil.copy(path, measured / "kept.npy")
    begin = time.monotonic()
    assert Ended(forced(measured)).code == 0
    longest = time.monotonic() - begin
    rng, ends = random.Random(fault), {}
    for _ in range(count(3, 40)):
        shutil.copy(measured / "kept.npy", path)
        process = forced(measured)
        time.sleep(rng.uniform(0, 0.9 * longest))
        was_running = process.poll() is None
        FAULTS[fault](path)
        ended = Ended(process)
        ends[ended.code] = ends.get(ended.code, 0) + 1
        if ended.code:
            assert ended.code in (1, 2) and is_error(ended), ended
            assert "map.npy" in ended.errors, ended
        elif was_running and fault != "rewritten":
            # The change came after the last look at the file.
            assert report(measured / "reports/a") == before
        assert report(measured / "reports/a") in (before,), "a result of two contents"
    print(fault, ends)
    shutil.copy(measured / "kept.npy", path)
    assert Ended(forced(measured)).code == 0
    assert report(measured / "reports/a") == before


def test_a_spec_that_changes_during_a_run_does_not_mix(place):
    """A run is that of the spec as it was read."""
    for _ in range(count(2, 10)):
        place.reset()
        process = start(cwd=place.folder)
        time.sleep(0.05)
        (place.folder / "experiments/a.toml").write_text("half a spe")
        ended = Ended(process)
        assert ended.code == 0 or "half" in ended.errors or "a.toml" in ended.errors, ended
        place.is_whole()
    place.edit(2)
    place.is_new_after_next_run()


def test_instruments_files_that_are_cut_at_any_byte(tmp_path):
    """A file of an instrument that is still being copied."""
    samples = sorted(path for path in SAMPLES.iterdir() if path.is_file() and path.stat().st_size < 400_000)
    assert samples
    rng, refused = random.Random(7), 0
    for sample in samples:
        if sample.suffix in (".md", ".py", ".json", ".txt"):
            continue
        whole = sample.read_bytes()
        path = tmp_path / sample.name
        for _ in range(count(1, 10)):
            path.write_bytes(whole[: rng.randrange(len(whole))])
            ended = run("surface", path.name, "--quiet", "--out", "out", cwd=tmp_path)
            assert ended.code in (0, 1, 2), (path.name, path.stat().st_size, ended)
            assert ended.code == 0 or path.name in ended.errors or "surface-" in ended.errors, ended
            refused += ended.code != 0
    print(refused, "of", count(1, 10) * len(samples), "cut files refused")
