"""Latencies of the workbench in a browser: from a value that is entered to the card, curves and contacts on the screen.

EXPERIMENT=target/release/experiment python benches/comparison/workbench.py

It needs Playwright and Chromium (tests/browser/requirements.txt). Times are medians over `REPEATS` changes, with the largest; each change is made
while the intervals of the one before are computed.
"""

import array
import json
import os
import pathlib
import random
import shutil
import statistics
import subprocess
import tempfile
import urllib.request

from playwright.sync_api import sync_playwright

PROGRAM = os.environ.get("EXPERIMENT", "experiment")
REPEATS = 15
SIDE = 1024

# From the end of an input until the first frame is painted in which card, curves and contacts are up to date.
CHANGE = """async (control, value) => {
    const count = () => performance.getEntriesByName("results-models").length;
    control.value = value;
    control.dispatchEvent(new Event("input", { bubbles: true }));
    await new Promise(resolve => requestAnimationFrame(() => requestAnimationFrame(resolve)));
    const before = count();
    const start = performance.now();
    control.dispatchEvent(new KeyboardEvent("keydown", { key: "Enter", bubbles: true }));
    const isNew = () => count() > before && !document.querySelector(".results.outdated");
    while (!isNew()) await new Promise(resolve => setTimeout(resolve, 1));
    await new Promise(resolve => requestAnimationFrame(() => setTimeout(resolve)));
    return performance.now() - start;
}"""


def map_of_noise(path, side=SIDE):
    """White noise averaged over 4 x 4 points, as a .npy of f4: about 80,000 summits on a million points."""
    draw = random.Random(1).random
    rows = [[draw() for _ in range(side + 4)] for _ in range(side + 4)]
    across = [[sum(row[k : k + 4]) for k in range(side)] for row in rows]
    heights = array.array("f")
    for x in range(side):
        heights.extend(1e-8 * (a + b + c + d) for a, b, c, d in zip(*across[x : x + 4], strict=True))
    head = f"{{'descr': '<f4', 'fortran_order': False, 'shape': ({side}, {side}), }}"
    head += " " * (117 - len(head)) + "\n"
    path.write_bytes(b"\x93NUMPY\x01\x00" + len(head).to_bytes(2, "little") + head.encode() + heights.tobytes())


def spec(surface, layer=None, **compare):
    return {
        "title": "Latency",
        "material": {"steel": {"from": "steel-100Cr6"}, **({layer: {"from": layer}} if layer else {})},
        "compare": {"rough": "steel", "flat": "steel", "law": "zmc", "separation": {"from": 4, "to": 0, "points": 41}, **({"layer": {"material": layer, "thickness": "2 um"}} if layer else {}), **compare},
        "surface": surface,
    }


POPULATION = {"a": {"population": {"radius": "20 um", "sigma": "48 nm", "density": "6e10 /m^2", "count": 100_000}}}
MAP = {"a": {"file": {"path": "noise.npy", "pixel": "0.2 um"}}}
CASES = [
    ("100,000 asperities, load", spec(POPULATION, pressure="1 MPa"), "key-compare-pressure", lambda k: f"{1 + 0.1 * k} MPa"),
    ("100,000 asperities under a layer, thickness", spec(POPULATION, "coating-DLC", pressure="1 MPa"), "key-compare-layer-thickness", lambda k: f"{2 + 0.7 * k} um"),
    ("map of 1024 x 1024 points, load", spec(MAP, pressure="1 MPa"), "key-compare-pressure", lambda k: f"{1 + 0.1 * k} MPa"),
    ("the same, S filter", spec(MAP, pressure="1 MPa"), "key-surface-a-file-filter-s", lambda k: f"{1 + 0.05 * k} um"),
]


def main():
    with tempfile.TemporaryDirectory() as name, sync_playwright() as playwright:
        folder = pathlib.Path(name)
        map_of_noise(folder / "noise.npy")
        environment = {**os.environ, "XDG_CONFIG_HOME": str(folder / "config")}
        server = subprocess.Popen([PROGRAM, "serve", name, "--no-open"], stdout=subprocess.PIPE, text=True, env=environment)
        address = server.stdout.readline().strip()
        browser = playwright.chromium.launch(executable_path=shutil.which("chromium"), args=["--no-sandbox"])
        page = browser.new_page(viewport={"width": 1280, "height": 900})
        page.set_default_timeout(120_000)
        page.goto(address)
        page.wait_for_selector(".start")
        origin = page.url.rstrip("/#")
        print(f"{'change':<48} {'median':>8} {'largest':>8}")

        page.set_input_files("input[type=file]", folder / "noise.npy")
        page.fill("input[name=pixel]", "0.2 um")
        took = page.evaluate(
            """async () => {
                const start = performance.now();
                document.querySelector(".waits button").click();
                while (!document.querySelector(".heights canvas") || !document.querySelector(".surface td")) await new Promise(resolve => setTimeout(resolve, 1));
                await new Promise(resolve => requestAnimationFrame(() => requestAnimationFrame(resolve)));
                return performance.now() - start;
            }"""
        )
        print(f"{'a map of 1024 x 1024 points, first shown':<48} {took:>5.0f} ms {took:>5.0f} ms")

        for what, start, control, value in CASES:
            state = json.dumps({"spec": start, "folder": "", "saved": None, "waits": [], "kept": []})
            page.goto("about:blank")
            page.goto(f"{origin}/#{urllib.request.quote(state)}")
            page.wait_for_selector("text=Complete after")
            field = page.locator(f"input#{control}")
            times = []
            for k in range(1, REPEATS + 1):
                times.append(field.evaluate(CHANGE, value(k)))
                page.wait_for_timeout(60)
            print(f"{what:<48} {statistics.median(times):>5.0f} ms {max(times):>5.0f} ms")
        browser.close()
        server.kill()


if __name__ == "__main__":
    main()
