"""Runs side by side, a folder that goes, output that nobody takes, a clock that jumps, memory that is limited."""

import pathlib
import resource
import shutil
import signal
import subprocess
import time

import pytest

from conftest import IS_FULL, PROGRAM, Ended, count, fails, is_error, leftovers, run, start

LIBFAKETIME = next(iter(pathlib.Path("/usr/lib").glob("*/faketime/libfaketimeMT.so.1")), None)


def test_two_runs_into_one_folder(several):
    """One of them at least writes; another says that the folder is in use. No report is of both."""
    busy = 0
    for _ in range(count(3, 30)):
        several.reset()
        runs = [start("--force", cwd=several.folder) for _ in range(3)]
        ends = [Ended(one) for one in runs]
        assert any(ended.code == 0 for ended in ends), ends
        for ended in ends:
            if ended.code:
                fails(ended, "another run is writing to reports", "wait for it to end")
                busy += 1
        assert several.is_whole() == 3
        several.is_new_after_next_run()
    print("busy", busy)


def test_two_runs_into_a_new_folder(several):
    for trial in range(count(2, 20)):
        out = several.folder / f"new-{trial}"
        runs = [start("--out", out, cwd=several.folder) for _ in range(3)]
        ends = [Ended(one) for one in runs]
        assert any(ended.code == 0 for ended in ends), ends
        several.is_new_after_next_run(out)


def test_a_lock_that_stays_as_a_file_is_no_lock(place):
    (place.out / ".lock").write_text("12345\n")
    place.is_new_after_next_run()


def test_a_folder_of_reports_that_is_removed_during_a_run(several):
    """The run writes what it has found into a new folder, or says what happened; it never leaves half a report."""
    longest = 0.6
    for trial in range(count(3, 40)):
        several.reset()
        process = start("--force", cwd=several.folder)
        time.sleep(longest * trial / count(3, 40))
        shutil.rmtree(several.out, ignore_errors=True)
        ended = Ended(process)
        if ended.code:
            fails(ended, "reports")
        if several.out.exists():
            assert leftovers(several.out) == [], ended
        several.is_new_after_next_run()


COMMANDS = [
    "schema", "materials", "completions bash", "explain compare.law", "explain curves.csv", "list", "--help", "run --help",
    "check experiments/a.toml", "run experiments/a.toml --force",
]


@pytest.mark.parametrize("command", COMMANDS)
def test_output_that_nobody_takes(place, command):
    """A pipe that is closed ends in silence; a full disk is an error; a stream that is not there is no fault of the program."""
    process = start(*command.split(), cwd=place.folder)
    process.stdout.close()
    errors = process.stderr.read()
    assert process.wait() == 0 and errors == "", errors
    with open("/dev/full", "w") as full:
        ended = run(*command.split(), cwd=place.folder, stdout=full)
    if "--help" not in command:
        fails(ended, "standard output", "No space left")
    assert run(*command.split(), cwd=place.folder, stderr=subprocess.DEVNULL).code == 0
    process = subprocess.run([f"{PROGRAM} {command} >&- 2>&-"], shell=True, cwd=place.folder)
    assert process.returncode == 0
    with open("/dev/full", "w") as full:
        assert run(*command.split(), cwd=place.folder, stderr=full).code == 0


@pytest.mark.skipif(not LIBFAKETIME, reason="libfaketime is not installed")
@pytest.mark.parametrize("clock", ["-10y", "+30y", "@1960-01-01 00:00:00", "-1d x5000", "+0 x0.01", "-1d i-3600"])
def test_a_clock_that_jumps(place, clock):
    """Nothing but times depends on the clock, also where the monotonic one jumps too."""
    environment = {"LD_PRELOAD": str(LIBFAKETIME), "FAKETIME": clock, "FAKETIME_NO_CACHE": "1", "PATH": "/usr/bin:/bin"}
    ended = run(cwd=place.folder, env=environment)
    assert ended.code == 0, ended
    assert place.is_whole() == 1
    place.is_new_after_next_run()


def limited(place, megabytes):
    """A run with a limit of its address space, as by `ulimit -v`."""
    limit = megabytes << 20
    return Ended(start(cwd=place.folder, preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_AS, (limit, limit))))


def test_what_does_not_fit_into_memory_is_refused(place):
    """By the limit of the process, with file, line and key, before anything runs."""
    place.edit(2)
    path = place.folder / "experiments/a.toml"
    path.write_text(path.read_text().replace("count = 2000", "count = 20000000"))
    fails(limited(place, 512), "a.toml, line", "GB of memory; available: 0.", code=2)
    place.is_old()


# A shell in a container of 300 MB, which shows its limits where those of the machine are. Its memory is full of cached files, as
# after a build.
CONTAINER = """
set -e
echo 300M > "$1/$2"
echo $$ > "$1/cgroup.procs"
mount --bind "$1" "$(dirname "$1")"
dd if=/dev/zero of=cached bs=1M count=400 status=none
exec "$3"
"""


@pytest.fixture
def container():
    """Its folder and the file of its limit."""
    machine = pathlib.Path("/sys/fs/cgroup")
    if (machine / "memory").is_dir():
        machine /= "memory"
    folder = machine / "asperity-faults"
    try:
        folder.mkdir()
    except OSError as error:
        pytest.skip(str(error))
    limit = next((name for name in ("memory.max", "memory.limit_in_bytes") if (folder / name).exists()), None)
    try:
        if limit is None or subprocess.run(["unshare", "--mount", "true"], capture_output=True).returncode:
            pytest.skip("no container can be made")
        yield folder, limit
    finally:
        folder.rmdir()


def test_a_container_has_what_its_processes_do_not_hold(place, container):
    def contained():
        return Ended(subprocess.Popen(
            ["unshare", "--mount", "bash", "-c", CONTAINER, "bash", *container, PROGRAM],
            cwd=place.folder, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True,
        ))

    place.edit(2)
    ended = contained()
    assert ended.code == 0, ended
    path = place.folder / "experiments/a.toml"
    path.write_text(path.read_text().replace("count = 2000", "count = 20000000"))
    fails(contained(), "a.toml, line", "GB of memory; available: 0.3 GB", code=2)


@pytest.mark.parametrize("megabytes", range(64, 400, 8 if IS_FULL else 64))
def test_no_limit_of_memory_damages_a_report(place, megabytes):
    """Too little for what an estimate leaves out ends the program by SIGABRT, with a line of the system's own."""
    ended = limited(place, megabytes)
    print(megabytes, ended.code)
    if ended.code == -signal.SIGABRT:
        assert "memory allocation of" in ended.errors, ended
    else:
        assert ended.code in (0, 1, 2), ended
        assert ended.code == 0 or is_error(ended), ended
    place.is_whole()
    place.is_new_after_next_run()
