"""The Python of docs/tutorial.md, on the spec that it saves: every output as quoted. `tests/experiment/tutorial.rs` runs its commands."""

import doctest
import re
from pathlib import Path

TUTORIAL = Path(__file__).resolve().parents[3] / "docs" / "tutorial.md"


def blocks(text):
    """The fenced blocks: (language and name of a file, text)."""
    return re.findall(r"^```(\S+(?: \S+)?)\n(.*?)^```$", text, re.MULTILINE | re.DOTALL)


def test_the_tutorial_holds_what_it_says(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    tutorial = TUTORIAL.read_text(encoding="utf-8")
    found = blocks(tutorial)
    for info, text in found:
        if info.startswith("toml "):
            (tmp_path / info.removeprefix("toml ")).write_text(text, encoding="utf-8")
    python = "\n".join(text for info, text in found if info == "python")
    test = doctest.DocTestParser().get_doctest(python, {}, "tutorial", str(TUTORIAL), 0)
    assert len(test.examples) > 5
    said = []
    doctest.DocTestRunner().run(test, out=said.append)
    assert not said, "".join(said)

    # The range in its answer is that over the spectra.
    areas = [int(area) for area in re.findall(r"^(\d+) µm²; integral", python, re.MULTILINE)]
    assert len(areas) == 4
    assert f"{round(min(areas), -2):,} to {round(max(areas), -2):,} µm²" in tutorial
