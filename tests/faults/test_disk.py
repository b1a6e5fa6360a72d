"""A disk that is full, that fails, or that may not be written to: one error, and the report that was there."""

import os
import resource
import shutil
import signal
import subprocess

import pytest

from conftest import PROGRAM, Ended, count, fails, leftovers, report, run, spec, start

FULL = ("No space left", "free some space")


def unprivileged(*arguments, cwd, **options):
    """The program of a user who is not root."""
    if os.geteuid() != 0:
        return run(*arguments, cwd=cwd, **options)
    program = subprocess.Popen(
        ["setpriv", "--reuid=65534", "--regid=65534", "--clear-groups", PROGRAM, *map(str, arguments)],
        cwd=cwd, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, **options,
    )
    return Ended(program)


@pytest.fixture
def open_to_all(place):
    """The way to a place, which pytest keeps to root, is opened."""
    for folder in (place.folder, *list(place.folder.parents)[:4]):
        folder.chmod(folder.stat().st_mode | 0o755)
    for path in place.folder.rglob("*"):
        path.chmod(0o777 if path.is_dir() else 0o666)
    return place


def test_a_disk_of_any_size_that_is_too_small(place, small_disk):
    """From one that holds the old report alone to one that holds all: whole at each size, and the next run works once there is space."""
    disk = small_disk("disk", "size=4m")
    out = disk / "reports"
    place.reset(out)
    used = sum(path.stat().st_blocks * 512 for path in out.rglob("*"))
    failed = 0
    for size in range(used // 4096 + 2, used // 4096 + 400, count(25, 1)):
        place.reset(out)
        subprocess.run(["mount", "-o", f"remount,size={size * 4}k", disk], check=True)
        ended = run("--out", out, cwd=place.folder)
        place.is_whole(out)
        if ended.code == 0:
            place.is_new_after_next_run(out)
            break
        failed += 1
        fails(ended, *FULL)
        assert leftovers(out) == []
        subprocess.run(["mount", "-o", "remount,size=4m", disk], check=True)
        place.is_new_after_next_run(out)
    print("sizes that failed", failed)
    assert ended.code == 0 and failed > count(1, 20)


def test_a_disk_without_free_inodes(place, small_disk):
    disk = small_disk("disk", "size=4m,nr_inodes=40")
    out = disk / "reports"
    place.reset(out)
    fails(run("--out", out, cwd=place.folder), *FULL)
    place.is_old(out)
    subprocess.run(["mount", "-o", "remount,nr_inodes=400", disk], check=True)
    place.is_new_after_next_run(out)


@pytest.mark.parametrize("is_ignored", [False, True])
def test_a_limit_of_file_size(place, is_ignored):
    """`ulimit -f`: the system ends the program by SIGXFSZ, or where that is ignored, refuses."""
    bytes_ = 50_000
    process = start(
        cwd=place.folder, restore_signals=not is_ignored,
        preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_FSIZE, (bytes_, bytes_)),
    )
    ended = Ended(process)
    if is_ignored:
        fails(ended, "File too large", ".a.asperity-new", "ulimit -f")
    else:
        assert ended.code == -signal.SIGXFSZ, ended
    assert place.is_whole() == 0
    place.is_new_after_next_run()


def test_few_open_files(place):
    process = start(cwd=place.folder, preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_NOFILE, (6, 6)))
    ended = Ended(process)
    assert ended.code in (0, 1, 2), ended
    place.is_whole()
    place.is_new_after_next_run()


@pytest.mark.skipif(not shutil.which("strace"), reason="strace is not installed")
@pytest.mark.parametrize("error", ["EIO", "ENOSPC", "EDQUOT", "EINTR"])
@pytest.mark.parametrize("call", ["write", "fsync", "mkdir", "rename", "renameat2", "unlinkat"])
def test_a_call_that_fails(place, call, error):
    """The first, second, ... call of the system of a kind fails, until a run makes no more of them. EINTR is made again."""
    step, at = count(25, 1), 1
    while True:
        place.reset()
        # Errors of writes to the terminal are other faults: `--quiet`.
        process = subprocess.run(
            ["strace", "-f", "-qq", "-o", place.folder / "calls", "-e", f"trace={call}", "-e", f"inject={call}:error={error}:when={at}",
             PROGRAM, "--quiet"],
            cwd=place.folder, capture_output=True, text=True,
        )
        was_hit = "(INJECTED)" in (place.folder / "calls").read_text()
        assert "panicked" not in process.stderr, process
        assert process.returncode in (0, 1, 2), process
        place.is_whole()
        if process.returncode:
            assert "error: " in process.stderr, process
        if not was_hit:
            break
        if error == "EINTR" and call == "write":
            assert process.returncode == 0, process
        place.is_new_after_next_run()
        at += step
    print(call, error, at - step)


def test_a_folder_that_may_only_be_read(open_to_all):
    place = open_to_all
    place.out.chmod(0o555)
    (place.out / "a").chmod(0o555)
    fails(unprivileged(cwd=place.folder), "Permission denied", "reports", "choose another folder")
    place.out.chmod(0o777)
    place.is_old()
    # The folder of a report, of which the user may not remove files: nothing of it may be lost.
    ended = unprivileged(cwd=place.folder)
    assert ended.code == 1, ended
    fails(ended, "Permission denied", "choose another folder")
    place.is_whole()
    (place.out / "a").chmod(0o777)
    for path in place.out.glob(".a.asperity-*"):
        path.chmod(0o777)
    place.is_new_after_next_run()


def test_a_place_that_may_not_be_made_is_refused_before_the_run(open_to_all):
    place = open_to_all
    above = place.folder / "above"
    above.mkdir()
    above.chmod(0o555)
    large = spec(1, keys='radius = "20 um"\nsigma = "48 nm"\ndensity = "6e10 /m^2"\ncount = 1000000\nrealisations = 100\n')
    (place.folder / "large.toml").write_text(large)
    ended = unprivileged("run", "large.toml", "--out", above / "reports", cwd=place.folder)
    fails(ended, "Permission denied", "choose another folder")
    assert list(above.iterdir()) == []


def test_a_file_system_that_may_only_be_read(place, small_disk):
    disk = small_disk("disk", "size=4m")
    out = disk / "reports"
    place.reset(out)
    subprocess.run(["mount", "-o", "remount,ro", disk], check=True)
    for folder in (out, disk / "new/reports"):
        fails(run("--out", folder, cwd=place.folder), "Read-only file system", "choose another folder")
    subprocess.run(["mount", "-o", "remount,rw", disk], check=True)
    place.is_old(out)
    place.is_new_after_next_run(out)


@pytest.mark.parametrize("what", ["spec", "list"])
def test_input_that_may_not_be_read(open_to_all, what):
    place = open_to_all
    (place.folder / "list.csv").write_text("height,radius\n" + "".join(f"{k}e-9,2e-5\n" for k in range(100)))
    (place.folder / "experiments/a.toml").write_text(spec(2, "asperities", 'file = "../list.csv"\nnominal-area = "1 mm^2"'))
    path = {"spec": place.folder / "experiments/a.toml", "list": place.folder / "list.csv"}[what]
    path.chmod(0)
    fails(unprivileged(cwd=place.folder), path.name, "Permission denied", code=2)
    place.is_old()


def test_places_that_are_no_folders(place):
    """A file, a link that leads nowhere, and a link to a folder, which is one."""
    folder = place.folder
    (folder / "file").write_text("mine")
    fails(run("--out", "file", cwd=folder), "file is a file", code=2)
    (folder / "nowhere").symlink_to("gone/reports")
    fails(run("--out", "nowhere", cwd=folder), "nowhere", "gone/reports", code=2)
    assert not (folder / "gone").exists()
    (folder / "link").symlink_to("reports")
    place.is_new_after_next_run(folder / "link")
    assert (folder / "file").read_text() == "mine"


def test_texts_that_are_written_once(place, small_disk):
    """A template, a saved spec, an export: nothing half written is left where the disk is full."""
    disk = small_disk("disk", "size=64k")
    height = "".join(" ".join(f"{(7 * i * i + 13 * j * j + i * j) % 97}" for j in range(32)) + "\n" for i in range(32))
    (place.folder / "map.txt").write_text(height)
    (disk / "filler").write_bytes(b"x" * 65536)
    before = sorted(disk.iterdir())
    fails(run("new", disk / "template", cwd=place.folder), *FULL)
    surface = ("surface", "map.txt", "--pixel", "1 um", "--unit", "nm", "--out", place.folder / "surface")
    fails(run(*surface, "--save-spec", disk / "saved.toml", cwd=place.folder), *FULL)
    fails(run("export", "interface", "experiments/a.toml", "--out", disk, cwd=place.folder), *FULL)
    assert sorted(disk.iterdir()) == before
