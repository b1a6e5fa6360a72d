"""A run that is ended at any moment leaves each report as it was before or as it is after, and nothing that is in the way."""

import random
import shutil
import signal
import subprocess
import time

import pytest

from conftest import IS_FULL, PROGRAM, Ended, content, count, leftovers, report, run, spec, start

# What a run does to the disk.
CALLS = ["openat", "write", "fsync", "mkdir", "rename", "renameat2", "unlinkat", "unlink", "rmdir", "ftruncate", "flock"]


def duration(place, *arguments):
    """Seconds of a run."""
    begin = time.monotonic()
    assert run(*arguments, cwd=place.folder).code == 0
    return time.monotonic() - begin


def ended_at(seconds, number, *arguments, cwd):
    """A program to which a signal is sent after so many seconds."""
    process = start(*arguments, cwd=cwd)
    try:
        process.wait(seconds)
    except subprocess.TimeoutExpired:
        process.send_signal(number)
    return Ended(process)


@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGTERM, signal.SIGKILL], ids=lambda number: number.name)
def test_at_random_moments(several, number):
    rng, longest = random.Random(number), duration(several)
    codes = {0: 0}
    for _ in range(count(3, 200 if number == signal.SIGKILL else 100)):
        several.reset()
        ended = ended_at(rng.uniform(0, longest), number, cwd=several.folder)
        codes[ended.code] = codes.get(ended.code, 0) + 1
        new = several.is_whole()
        if ended.code == 128 + number:
            assert "interrupted; " in ended.errors and str(new or "nothing") in ended.errors, ended
            assert leftovers(several.out) == []
        several.is_new_after_next_run()
    print(number.name, {code: codes[code] for code in sorted(codes)})
    # Before `main` the system ends a program.
    assert set(codes) <= {0, -number} | ({128 + number} if number != signal.SIGKILL else set())


@pytest.mark.skipif(not shutil.which("strace"), reason="strace is not installed")
@pytest.mark.parametrize("call", CALLS)
def test_at_each_step_on_the_disk(place, call):
    """A kill at the first, second, ... call of the system of a kind, until a run makes no more of them."""
    step, was_ended, ends = count(17, 1), True, 0
    at = 1
    while was_ended:
        place.reset()
        inject = f"{call}:signal=KILL:when={at}"
        process = subprocess.run(
            ["strace", "-f", "-qq", "-o", "/dev/null", "-e", f"trace={call}", "-e", f"inject={inject}", PROGRAM],
            cwd=place.folder, capture_output=True, text=True,
        )
        was_ended = process.returncode != 0
        assert was_ended or process.returncode == 0, process
        place.is_whole()
        place.is_new_after_next_run()
        ends += was_ended
        at += step
    print(call, ends)


def test_leftovers_of_many_kills_do_not_add_up(place):
    rng, longest = random.Random(3), duration(place)
    most = 0
    for _ in range(count(6, 50)):
        # The report stays the old one for the next kill, which meets what the last one left.
        if place.is_whole() == 1:
            place.reset()
        ended_at(rng.uniform(0.5 * longest, longest), signal.SIGKILL, cwd=place.folder)
        place.is_whole()
        most = max(most, len(leftovers(place.out)))
    assert most <= 2
    place.is_new_after_next_run()


def test_signals_that_mean_nothing_change_nothing(place):
    """System calls that signals interrupt (EINTR) are made again; a stopped run goes on."""
    process = start(cwd=place.folder)
    while process.poll() is None:
        for number in (signal.SIGWINCH, signal.SIGSTOP, signal.SIGCONT, signal.SIGCHLD, signal.SIGURG):
            if process.poll() is None:
                process.send_signal(number)
        time.sleep(0.001)
    assert Ended(process).code == 0
    place.is_new_after_next_run()


SWEEP = spec(1) + """
[sweep]
"surface.a.population.sigma" = ["40 nm", "48 nm", "56 nm", "64 nm", "72 nm", "80 nm"]
"""


def test_sweeps_at_random_moments(tmp_path):
    """A sweep that is killed again and again goes on, and ends with the report of one that was not."""
    (tmp_path / "s.toml").write_text(SWEEP)
    begin = time.monotonic()
    assert run("run", "s.toml", "--out", "whole", cwd=tmp_path).code == 0
    longest = time.monotonic() - begin
    rng = random.Random(6)
    for trial in range(count(2, 20)):
        out = tmp_path / f"out-{trial}"
        for kill in range(6):
            number = signal.SIGKILL if kill % 2 else signal.SIGINT
            ended_at(rng.uniform(0, longest), number, "run", "s.toml", "--out", out, cwd=tmp_path)
            if out.exists():
                assert report(out / "s") in (None, report(tmp_path / "whole/s"))
        assert run("run", "s.toml", "--out", out, cwd=tmp_path).code == 0
        assert report(out / "s") == report(tmp_path / "whole/s")
        assert leftovers(out) == leftovers(tmp_path / "whole")
        kept = [path.name for path in (out / ".kept/s").iterdir()]
        assert sorted(kept) == sorted(path.name for path in (tmp_path / "whole/.kept/s").iterdir())


def test_exports_at_random_moments(place):
    """Each file of an export is the old one, the new one, or not there; what kills leave goes with the next export."""
    export = ("export", "asperities", "experiments/a.toml", "--out", "exported", "--force")
    folder = place.folder / "exported"
    versions = []
    for seed in (1, 2):
        place.edit(seed)
        assert run(*export, cwd=place.folder).code == 0
        versions.append(content(folder))
    longest = duration(place, *export)
    rng = random.Random(8)
    for trial in range(count(4, 50)):
        place.edit(1 + trial % 2)
        ended_at(rng.uniform(0, longest), signal.SIGKILL, *export, cwd=place.folder)
        assert all(found in [version[name] for version in versions] for name, found in content(folder).items())
    assert run(*export, cwd=place.folder).code == 0
    assert content(folder) in versions
    assert leftovers(folder) == []


GENERATED = """\
points = 700
pixel = "1 um"
spectrum.self-affine = { hurst = 0.8, roll-off = "64 um", cut-off = "8 um" }
sigma = "100 nm"
"""


@pytest.mark.parametrize("form", ["xyz", "x3p"])
def test_exports_end_at_once(tmp_path, form):
    """An interrupted export leaves neither a part of a file nor what was to become one, and does not wait for a large file."""
    (tmp_path / "g.toml").write_text(spec(1, "generate", GENERATED))
    export = ("export", "map", "g.toml", "--format", form, "--out", "exported", "--force")
    folder = tmp_path / "exported"
    begin = time.monotonic()
    assert run(*export, cwd=tmp_path).code == 0
    longest, whole = time.monotonic() - begin, content(folder)
    rng = random.Random(9)
    for trial in range(count(5, 50)):
        if trial % 2:
            shutil.rmtree(folder, ignore_errors=True)
        number = signal.SIGINT if trial % 3 else signal.SIGTERM
        ended = ended_at(rng.uniform(0.1 * longest, longest), number, *export, cwd=tmp_path)
        assert ended.code in (0, -number, 128 + number), ended
        if ended.code == 128 + number:
            assert "interrupted; " in ended.errors and "error" not in ended.errors.lower() and "fail" not in ended.errors.lower(), ended
        if folder.exists():
            assert leftovers(folder) == [] and content(folder) in (whole, {}), ended
