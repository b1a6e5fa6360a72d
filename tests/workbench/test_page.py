"""The workbench as a person uses it, in a headless Chromium."""

import json
import os
import pathlib
import re
import shutil
import signal
import struct
import subprocess
from html import unescape
from urllib.parse import unquote

import pytest
from axe_playwright_python.sync_playwright import Axe
from playwright.sync_api import expect, sync_playwright

from conftest import PROGRAM, full

ROOT = pathlib.Path(__file__).parents[2]
SURFACES = ROOT / "experiments" / "surfaces"
SAMPLES = ROOT / "crates" / "asperity" / "tests" / "library" / "formats" / "samples"
COMPLETE = "Complete after"
# A computation of the example, on a busy machine.
LONG = 60_000

POPULATION = {
    "title": "A population",
    "material": {"steel": {"from": "steel-100Cr6"}},
    "compare": {"rough": "steel", "flat": "steel", "law": "zmc", "separation": {"from": 3, "to": 0, "points": 11}},
    "surface": {"a": {"population": {"radius": "20 um", "sigma": "48 nm", "density": "6e10 /m^2", "count": 1000}}},
}


@pytest.fixture(scope="module")
def browser():
    program = shutil.which("chromium") or shutil.which("chromium-browser") or shutil.which("google-chrome")
    with sync_playwright() as playwright:
        browser = playwright.chromium.launch(executable_path=program, args=["--no-sandbox"])
        yield browser
        browser.close()


@pytest.fixture
def visit(browser):
    """Opens an address; the page may report no error that the test does not expect."""
    contexts, errors = [], []

    def opened(address, width=1280, height=900, expected=(), **options):
        context = browser.new_context(viewport={"width": width, "height": height}, permissions=["clipboard-read", "clipboard-write"], **options)
        context.set_default_timeout(LONG)
        contexts.append(context)
        page = context.new_page()
        page.on("pageerror", lambda error: errors.append(str(error)))
        page.on("console", lambda message: errors.append(message.text) if message.type in ("error", "warning") and not any(text in message.text for text in expected) else None)
        page.goto(address)
        return page

    yield opened
    for context in contexts:
        context.close()
    assert not errors, errors


REFUSED = ("422",)
GONE = ("ERR_CONNECTION_REFUSED", "ERR_INCOMPLETE_CHUNKED_ENCODING", "ERR_CONNECTION_RESET", "ERR_EMPTY_RESPONSE")


def key(page, *path):
    """The control of a key."""
    name = "-".join(path)
    return page.locator(f'[id="key-{re.sub(r"[^A-Za-z0-9_-]", "-", name)}"]')


def put(page, value, *path):
    key(page, *path).fill(value)
    key(page, *path).press("Enter")


def complete(page):
    """Waits for the end of a computation that has begun."""
    page.wait_for_timeout(100)
    expect(page.locator(".status")).to_contain_text(COMPLETE, timeout=LONG)
    assert page.locator(".results.outdated").count() == 0


def population(server, **changes):
    spec = json.loads(json.dumps(POPULATION))
    spec["surface"]["a"]["population"].update(changes)
    return spec


def use(page, **units):
    """Says what a file does not: the unit of its heights, or `xy` and `z`; without any that the dialog asks for: m."""
    page.locator(".waits").wait_for()
    for select in page.locator(".waits select").all():
        select.select_option(units.get(select.get_attribute("name").split(".")[-1], "m"))
    page.get_by_role("button", name="Use").click()


def save(server, spec, name):
    answer = server.post("/api/save", {"spec": spec, "folder": "", "name": name})
    assert answer.status == 200, answer.text


def open_spec(page, title):
    page.get_by_role("button", name=title, exact=True).click()


def card(page, label):
    return page.locator(".card div", has=page.locator("dt", has_text=label)).first.locator("dd").inner_text()


def area(page):
    """The contact area of the first card as a share of the nominal area."""
    found = re.search(r"on ([\d.]+) (mm|µm)² .*?: ([\d.]+) (mm|µm)²", card(page, "Result at"))
    unit = {"mm": 1e-6, "µm": 1e-12}
    return float(found[3]) * unit[found[4]] / (float(found[1]) * unit[found[2]])


def test_whoever_has_nothing_opens_the_example_and_its_address_brings_it_back(server, visit):
    page = visit(server.address)
    page.get_by_role("button", name="Open the example").click()
    expect(page.locator(".card")).to_contain_text("Result at the middle admissible load")
    complete(page)
    assert "No" in card(page, "May the integral") or "no" in card(page, "May the integral")
    page.locator(".heights canvas").wait_for()
    assert "24,714 asperities" in page.locator(".surface").inner_text()
    put(page, "3 um", "surface", "fine-finish", "file", "filter", "s")
    complete(page)
    before = card(page, "Result at")
    other = page.context.new_page()
    other.set_default_timeout(LONG)
    other.goto(page.url)
    complete(other)
    assert card(other, "Result at") == before
    assert key(other, "surface", "fine-finish", "file", "filter", "s").input_value() == "3 um"


def test_the_list_has_pictures_of_maps_and_answers_of_reports(server, visit, tmp_path):
    shutil.copy(SURFACES / "al3d-1.npy", server.folder / "surface.npy")
    asperities(server.folder)
    save(server, POPULATION, "population")
    server.events("/api/report", {"spec": POPULATION, "folder": "", "name": "population"})
    page = visit(server.address)
    canvas = page.locator("li", has_text="surface.npy").locator("canvas")
    expect(canvas).to_be_visible()
    assert canvas.evaluate("one => one.width > 50 && one.getContext('2d').getImageData(5, 5, 1, 1).data[3] === 255")
    expect(page.locator("li", has_text="peaks.csv").locator("canvas")).to_be_hidden()
    report = page.locator("li.report")
    expect(report).to_contain_text("On these asperities")
    assert report.locator("img").evaluate("one => one.decode().then(() => one.naturalWidth)") > 50


def x3p():
    return SURFACES / "x3p-2.x3p"


def height_at(x, y):
    return 1e-7 * ((7 * x * x + 3 * y + 5 * x * y) % 11) + 1e-9 * ((x * 31 + y * 17) % 97)


def text_of_heights(folder):
    path = folder / "heights.txt"
    rows = [[height_at(x, y) for x in range(24)] for y in range(20)]
    path.write_text("\n".join(" ".join(f"{height:.6e}" for height in row) for row in rows))
    return path


def points(folder):
    path = folder / "points.xyz"
    heights = ((x, y, height_at(x, y)) for x in range(24) for y in range(20))
    path.write_text("\n".join(f"{1e-6 * x:.6e} {1e-6 * y:.6e} {z:.6e}" for x, y, z in heights))
    return path


def asperities(folder):
    path = folder / "peaks.csv"
    path.write_text("height,radius\n" + "".join(f"{1e-8 * ((13 * k) % 17)},{1e-5 * (1 + k % 3)}\n" for k in range(60)))
    return path


@pytest.mark.parametrize("made", ["npy", "x3p", "opd", "txt", "xyz", "csv"])
def test_each_format_that_is_dropped_is_read_and_what_it_lacks_is_asked_for(server, visit, tmp_path, made):
    files = {"npy": lambda: SURFACES / "al3d-1.npy", "x3p": x3p, "opd": lambda: SAMPLES / "st-opd-1.opd", "txt": lambda: text_of_heights(tmp_path), "xyz": lambda: points(tmp_path), "csv": lambda: asperities(tmp_path)}
    path = files[made]()
    page = visit(server.address)
    page.locator("input[type=file]").set_input_files(path)
    form = page.locator(".waits form")
    if made in ("npy", "txt"):
        form.locator("input[name=pixel]").fill("0.5 um")
    if made == "csv":
        form.locator("input[name=nominal-area]").fill("0.01 mm^2")
    if made not in ("x3p", "opd"):
        use(page)
    complete(page)
    expect(page.locator(".surface h2")).to_contain_text(f"Surface {path.stem}")
    assert (server.folder / "uploads" / path.name).read_bytes() == path.read_bytes()
    if made != "csv":
        expect(page.locator(".surface .size")).to_contain_text("points")


def spec_of(page):
    """The spec that the page holds, of its address."""
    return json.loads(unquote(page.url.partition("#")[2]))["spec"]


FACTORS = {"m": 1.0, "cm": 1e-2, "mm": 1e-3, "um": 1e-6, "nm": 1e-9, "pm": 1e-12, "Å": 1e-10, "in": 0.0254, "mil": 0.0254e-3}


def lacking(made, folder, xy=1.0, z=1.0):
    """A file of the same heights in other units, which it does not name."""
    heights = [[height_at(x, y) / z for y in range(20)] for x in range(24)]
    path = folder / f"{made}.{made}"
    if made == "npy":
        head = "{'descr': '<f8', 'fortran_order': False, 'shape': (24, 20), }".ljust(117) + "\n"
        path.write_bytes(b"\x93NUMPY\x01\x00" + struct.pack("<H", 118) + head.encode() + struct.pack("<480d", *sum(heights, [])))
    elif made == "txt":
        path.write_text("\n".join(" ".join(f"{heights[x][y]:.9e}" for x in range(24)) for y in range(20)))
    else:
        path.write_text("\n".join(f"{1e-6 * x / xy:.9e} {1e-6 * y / xy:.9e} {heights[x][y]:.9e}" for x in range(24) for y in range(20)))
    return path


@pytest.mark.parametrize("made", ["npy", pytest.param("txt", marks=full), pytest.param("xyz", marks=full)])
def test_each_unit_that_is_chosen_is_used(server, visit, tmp_path, made):
    """The card of the same surface, whatever the unit that its file is in."""
    page = visit(server.address)
    results = {}
    for place, unit in enumerate(FACTORS):
        xy = list(FACTORS)[(place + 3) % len(FACTORS)]
        (folder := tmp_path / unit).mkdir()
        page.locator("input[type=file]").set_input_files(lacking(made, folder, FACTORS[xy], FACTORS[unit]))
        form = page.locator(".waits form")
        form.wait_for()
        selects = form.locator("select").all()
        assert [select.get_attribute("name") for select in selects] == (["unit.xy", "unit.z"] if made == "xyz" else ["unit"])
        assert [select.input_value() for select in selects] == [""] * len(selects)
        assert set(FACTORS) <= set(selects[0].locator("option").evaluate_all("all => all.map(one => one.value)"))
        if made != "xyz":
            form.locator("input[name=pixel]").fill("1 um")
        # Without a choice nothing happens.
        page.get_by_role("button", name="Use").click()
        assert page.locator(".waits").count() == 1
        use(page, unit=unit, xy=xy, z=unit)
        complete(page)
        (surface,) = spec_of(page)["surface"].values()
        assert surface["file"]["unit"] == ({"xy": xy, "z": unit} if made == "xyz" else unit)
        results[unit] = (card(page, "Result at"), page.locator(".surface .size").inner_text())
        page.get_by_role("button", name="Close").click()
        page.locator(".drop").wait_for()
    assert len(set(results.values())) == 1, results
    # Both units stand beside each other in the controls.
    page.go_back()
    page.locator(".controls").wait_for()
    labels = page.locator(".controls label").all_inner_texts()
    assert ("Unit of x and y" in labels and "Unit of the heights" in labels) if made == "xyz" else "Unit" in labels


def test_a_surface_that_fails_is_waited_for_no_longer(server, visit, tmp_path):
    page = visit(server.address, expected=REFUSED)
    page.locator("input[type=file]").set_input_files(lacking("txt", tmp_path, z=1e-9))
    page.locator("input[name=pixel]").fill("1 um")
    use(page, unit="m")
    expect(page.locator(".status.wrong")).to_contain_text("holds a height of")
    expect(page.locator(".surface .error")).to_contain_text("holds a height of")
    assert "Waiting for the surface" not in page.locator(".surface").inner_text()
    # What is chosen then ends it.
    key(page, "surface", "txt", "file", "unit").select_option("nm")
    complete(page)
    expect(page.locator(".surface .error")).to_have_count(0)
    page.locator(".heights canvas").wait_for()


def test_a_rectangle_is_cut_out_and_the_whole_map_comes_back(server, visit, tmp_path):
    page = visit(server.address)
    page.locator("input[type=file]").set_input_files(lacking("npy", tmp_path))
    page.locator("input[name=pixel]").fill("1 um")
    use(page)
    complete(page)
    canvas, line = page.locator(".heights canvas"), page.locator(".heights line")
    before = line.get_attribute("x1")

    def draw(x0, y0, x1, y1):
        page.get_by_role("button", name="Crop by a rectangle").click()
        canvas.scroll_into_view_if_needed()
        box = canvas.bounding_box()
        page.mouse.move(box["x"] + x0 * box["width"], box["y"] + (1 - y0) * box["height"])
        page.mouse.down()
        page.mouse.move(box["x"] + x1 * box["width"], box["y"] + (1 - y1) * box["height"], steps=3)
        assert page.locator(".heights rect").count() == 1
        page.mouse.up()
        complete(page)
        return spec_of(page)["surface"]["npy"]["file"].get("crop")

    def ends(crop):
        return {axis: [float(end.removesuffix(" um")) for end in crop[axis]] for axis in crop}

    # From the first point at the lower left, as heights of the first index along x.
    found = ends(draw(0.25, 0.01, 0.75, 0.5))
    assert found["x"] == pytest.approx([6, 18], abs=0.3) and found["y"] == pytest.approx([0, 10], abs=0.3)
    assert line.get_attribute("x1") == before
    expect(page.locator(".surface .size")).to_contain_text("× 10 points")
    shown = key(page, "surface", "npy", "file", "crop", "x").input_value()
    assert [float(end.removesuffix(" um")) for end in shown.split(", ")] == pytest.approx(found["x"], rel=1e-3)
    # A rectangle on the part is a part of the part.
    again = ends(draw(0.01, 0.01, 0.5, 0.99))
    assert again["x"] == pytest.approx([found["x"][0], found["x"][0] + 6], abs=0.8) and again["y"] == found["y"]
    page.get_by_role("button", name="Whole map").click()
    complete(page)
    assert "crop" not in spec_of(page)["surface"]["npy"]["file"]
    expect(page.locator(".surface .size")).to_contain_text("24 × 20 points")
    put(page, "2 um, 14 um", "surface", "npy", "file", "crop", "x")
    complete(page)
    assert spec_of(page)["surface"]["npy"]["file"]["crop"] == {"x": ["2 um", "14 um"]}
    expect(page.locator(".surface .size")).to_contain_text("12 × 20 points")


@full
def test_first_numbers_are_preliminary(server, visit):
    page = visit(server.address)
    page.get_by_role("button", name="Open the example").wait_for()
    page.evaluate("""() => {
      window.seen = new Set();
      new MutationObserver(() => document.querySelectorAll(".card dt").forEach(one => window.seen.add(one.textContent)))
        .observe(document.body, { childList: true, subtree: true, characterData: true });
    }""")
    page.get_by_role("button", name="Open the example").click()
    complete(page)
    assert [text for text in page.evaluate("[...window.seen]") if text.endswith("(preliminary)")]
    assert "preliminary" not in page.locator(".card").first.inner_text()
    # Lists have no empty entry, and numbers no more digits than anybody reads.
    assert page.locator(".controls option").evaluate_all("all => all.filter(one => !one.textContent.trim()).length") == 0
    pixel = key(page, "surface", "fine-finish", "file", "pixel")
    assert pixel.input_value() == "196.733 nm"
    pixel.focus()
    assert pixel.input_value() == "196.73303177114576 nm"
    pixel.blur()
    assert spec_of(page)["surface"]["fine-finish"]["file"]["pixel"] == "196.73303177114576 nm"


def test_a_file_that_is_no_map_is_refused_with_the_reason(server, visit, tmp_path):
    page = visit(server.address, expected=REFUSED)
    path = tmp_path / "<img src=x onerror=alert(1)>.npy"
    path.write_bytes(b"\x93NUMPY\x01\x00nothing")
    page.locator("input[type=file]").set_input_files(path)
    expect(page.locator(".message")).to_contain_text("img src=x")
    assert page.locator(".message img").count() == 0


def spiked(folder):
    """The fine finish, cut, with three spikes."""
    data = bytearray((SURFACES / "opd-1.npy").read_bytes())
    begin = 10 + struct.unpack("<H", data[8:10])[0]
    size = 8 if b"f8" in data[:begin] else 4
    code = {8: "<d", 4: "<f"}[size]
    for place, height in ((20_000, 2.0e-6), (60_000, 1.7e-6), (100_000, 2.3e-6)):
        data[begin + size * place : begin + size * (place + 1)] = struct.pack(code, height)
    path = folder / "spiked.npy"
    path.write_bytes(data)
    return path


def test_a_spiked_map_is_remedied_by_a_button(server, visit, tmp_path):
    page = visit(server.address)
    page.locator("input[type=file]").set_input_files(spiked(tmp_path))
    page.locator("input[name=pixel]").fill("0.1967 um")
    use(page)
    expect(page.locator(".blocked")).to_contain_text("fails a check")
    page.get_by_role("button", name='Try outliers = "remove"').click()
    attempt = page.locator(".attempt")
    expect(attempt).to_contain_text("The map passes")
    assert attempt.locator(".heights canvas").count() == 2
    assert page.locator(".surface td", has_text="(passed)").count() >= 1
    attempt.get_by_role("button", name="Apply").click()
    complete(page)
    expect(page.locator(".blocked")).to_have_count(0)
    assert key(page, "surface", "spiked", "file", "outliers").input_value() == "remove"
    page.get_by_role("button", name="Undo").click()
    expect(page.locator(".blocked")).to_contain_text("fails a check")


def test_the_coating_thickness_at_which_the_area_halves_is_found_with_a_slider(server, visit):
    spec = json.loads(json.dumps(POPULATION))
    spec["material"]["polymer"] = {"young": "3 GPa", "poisson": 0.4, "hardness": "0.2 GPa"}
    spec["compare"].update(rough="steel", flat="polymer", pressure="1 MPa")
    save(server, spec, "polymer")
    page = visit(server.address)
    open_spec(page, "A population")
    complete(page)
    bare = area(page)
    key(page, "compare", "layer", "material").select_option("coating-DLC")
    complete(page)
    slider = page.get_by_label("Thickness, slider")
    low, high = (float(slider.get_attribute(end)) for end in ("min", "max"))
    for _ in range(14):
        middle = (low + high) / 2
        slider.evaluate("(one, value) => { one.value = value; one.dispatchEvent(new Event('input', { bubbles: true })); }", middle)
        complete(page)
        low, high = (middle, high) if area(page) > bare / 2 else (low, middle)
    assert abs(area(page) / bare - 0.5) < 0.03
    thickness = key(page, "compare", "layer", "thickness").input_value()
    assert re.fullmatch(r"[\d.]+ (nm|um)", thickness), thickness


def test_a_report_has_the_bytes_of_experiment_run(server, visit, tmp_path):
    page = visit(server.address)
    page.get_by_role("button", name="Open the example").click()
    complete(page)
    put(page, "2.5 um", "surface", "fine-finish", "file", "filter", "s")
    complete(page)
    page.get_by_role("button", name="Write report").click()
    page.get_by_label("Name").fill("mine")
    page.get_by_role("button", name="Write", exact=True).click()
    expect(page.locator("dialog")).to_contain_text("The report is written", timeout=LONG)
    again = tmp_path / "again"
    subprocess.run([PROGRAM, "run", "mine.toml", "--out", str(again), "--quiet"], cwd=server.folder / "example", check=True)
    written = {path.name: path.read_bytes() for path in (server.folder / "reports" / "mine").iterdir()}
    own = {path.name: path.read_bytes() for path in (again / "mine").iterdir()}
    assert written.keys() == own.keys()
    timed = {"timing.json", "manifest.json"}
    assert not [name for name in own if name not in timed and written[name] != own[name]]
    # The page that it leads to is shown.
    with page.context.expect_page() as opened:
        page.locator("dialog a").click()
    expect(opened.value.locator(".card")).to_contain_text("May the integral replace the sum?")


def plain_text(html):
    """A text of a card without its markup, as a summary has it."""
    words = unescape(re.sub(r"<[^>]*>", "", html.replace("</p>", " "))).replace("\u2212", "-")
    return " ".join(words.split())


@full
def test_the_last_stage_says_what_experiment_run_says(server, tmp_path):
    """Also after another filter, with surfaces and sampling errors that are kept from stage to stage."""
    path = server.post("/api/example", {}).json["path"]
    found = server.post("/api/open", {"path": path}).json
    other = json.loads(json.dumps(found["spec"]))
    other["surface"]["fine-finish"]["file"]["filter"] = {"s": "3 um"}
    cards = []
    for spec in (found["spec"], other, found["spec"]):
        results = [value for name, value in server.events("/api/analyse", {"spec": spec, "folder": found["folder"]}, timeout=120) if name == "results"]
        assert [one["stage"] for one in results] == ["models", "intervals", "everything"]
        cards.append({line["key"]: plain_text(line["html"]) for line in results[-1]["results"]["cases"][0]["pieces"]["card"]})
    assert cards[0] == cards[2] != cards[1]
    subprocess.run([PROGRAM, "run", path, "--out", str(tmp_path / "out"), "--quiet"], cwd=server.folder, check=True)
    summary = json.loads((tmp_path / "out" / "measured-fine-finish" / "summary.json").read_text())
    expected = {line["key"]: " ".join(line["texts"]).replace("`", "") for line in summary["answer"]["lines"]}
    # Advice names the control.
    models = 'models = ["statistical", "deterministic", "reference"]', "Boundary elements: statistical, deterministic, reference"
    assert cards[0] == {key: text.replace(*models) for key, text in expected.items()}


def test_errors_stand_at_their_controls_and_can_be_undone(server, visit):
    save(server, POPULATION, "population")
    page = visit(server.address, expected=REFUSED)
    open_spec(page, "A population")
    complete(page)
    put(page, "3 parsecs", "surface", "a", "population", "sigma")
    row = page.locator(".row", has=key(page, "surface", "a", "population", "sigma"))
    expect(row.locator(".error")).to_contain_text("found \"3 parsecs\"; allowed")
    assert key(page, "surface", "a", "population", "sigma").get_attribute("aria-invalid") == "true"
    assert page.locator(".results.outdated").count() == 1
    page.get_by_role("button", name="Undo").click()
    complete(page)
    assert page.locator(".row .error").count() == 0
    page.get_by_role("button", name="Redo").click()
    expect(row.locator(".error")).to_contain_text("parsecs")


def test_up_to_eight_states_are_kept_and_laid_over_each_other(server, visit):
    save(server, POPULATION, "population")
    page = visit(server.address)
    open_spec(page, "A population")
    complete(page)
    for number in range(8):
        put(page, f"{40 + number} nm", "surface", "a", "population", "sigma")
        complete(page)
        page.get_by_role("button", name="Keep").click()
    assert page.get_by_role("button", name="Keep").is_disabled()
    rows = page.locator(".kept tbody tr")
    expect(rows).to_have_count(8)
    expect(rows.nth(7)).to_contain_text("contacts")
    page.reload()
    expect(rows).to_have_count(8)
    expect(rows.nth(7)).to_contain_text("contacts")
    expect(page.locator("#kept .names button")).to_have_count(16)
    rows.nth(0).get_by_role("button", name="Restore").click()
    complete(page)
    assert key(page, "surface", "a", "population", "sigma").input_value() == "40 nm"


def test_a_spec_is_saved_changed_as_text_and_never_overwritten_unasked(server, visit):
    save(server, POPULATION, "population")
    page = visit(server.address, expected=REFUSED)
    open_spec(page, "A population")
    complete(page)
    page.get_by_role("button", name="Spec …", exact=True).click()
    text = page.get_by_label("Spec", exact=True)
    text.fill(text.input_value().replace("48 nm", "60 nm"))
    page.get_by_role("button", name="Apply").click()
    complete(page)
    assert key(page, "surface", "a", "population", "sigma").input_value() == "60 nm"
    (server.folder / "population.toml").write_text("title = \"changed by another program\"\n")
    page.get_by_role("button", name="Save spec").click()
    assert page.get_by_label("Name").input_value() == "population-2"
    page.get_by_label("Name").fill("population")
    expect(page.locator("dialog")).to_contain_text("replaces the spec of this name with its comments")
    page.get_by_role("button", name="Replace", exact=True).click()
    expect(page.locator("dialog .error")).to_contain_text("not the one this page has read")
    page.get_by_label("Name").fill("other")
    page.get_by_role("button", name="Save", exact=True).click()
    expect(page.locator("dialog")).to_contain_text("Saved as other.toml")
    assert '"60 nm"' in (server.folder / "other.toml").read_text()
    assert "another program" in (server.folder / "population.toml").read_text()


def test_python_of_a_state_runs_it(server, visit):
    save(server, POPULATION, "population")
    page = visit(server.address)
    open_spec(page, "A population")
    page.get_by_role("button", name="Copy Python").click()
    expect(page.locator(".message")).to_contain_text("copied")
    text = page.evaluate("navigator.clipboard.readText()")
    scope = {}
    exec(re.search(r"spec = .*?^}", text, re.S | re.M)[0], scope)  # noqa: S102 (what the page copies)
    assert scope["spec"] == POPULATION
    assert "asperity.run(spec)" in text


def test_long_work_is_shown_and_cancelled_and_goes_on(server, visit):
    page = visit(server.address)
    page.get_by_role("button", name="Open the example").click()
    page.get_by_role("button", name="Run boundary elements").click()
    page.get_by_role("progressbar").wait_for()
    page.get_by_role("button", name="Cancel").click()
    expect(page.locator(".status")).to_contain_text("Cancelled")
    page.get_by_role("button", name="Continue").click()
    expect(page.get_by_role("progressbar")).to_be_visible()


@full
def test_a_thousand_changes_in_a_row(server, visit):
    save(server, POPULATION, "population")
    page = visit(server.address)
    open_spec(page, "A population")
    complete(page)
    slider = page.get_by_label("sigma, slider")
    ends = [float(slider.get_attribute(end)) for end in ("min", "max")]
    slider.evaluate(
        """async (one, [low, high]) => {
            for (let k = 0; k < 1000; k++) {
                one.value = low + (high - low) * (0.5 + 0.3 * Math.sin(k / 7));
                one.dispatchEvent(new Event("input", { bubbles: true }));
                await new Promise(resolve => setTimeout(resolve, 8));
            }
        }""",
        ends,
    )
    complete(page)
    sigma = key(page, "surface", "a", "population", "sigma").input_value()
    fresh = page.context.new_page()
    fresh.goto(page.url)
    complete(fresh)
    assert card(fresh, "Result at") == card(page, "Result at")
    assert key(fresh, "surface", "a", "population", "sigma").input_value() == sigma


@full
def test_eight_tabs_at_once(server, visit):
    save(server, population(server, count=20_000), "population")
    first = visit(server.address)
    open_spec(first, "A population")
    complete(first)
    pages = [first.context.new_page() for _ in range(7)]
    for page in pages:
        page.goto(first.url)
    for number, page in enumerate(pages):
        complete(page)
        put(page, f"{30 + number} nm", "surface", "a", "population", "sigma")
    for page in pages:
        complete(page)
    assert len({card(page, "Result at") for page in pages}) == 7


def test_a_file_that_changes_or_vanishes(server, visit, tmp_path):
    page = visit(server.address, expected=REFUSED)
    page.locator("input[type=file]").set_input_files(points(tmp_path))
    use(page)
    complete(page)
    before = card(page, "Result at")
    path = server.folder / "uploads" / "points.xyz"
    text = path.read_text()
    path.write_text(text.replace("e-07\n", "e-08\n"))
    page.evaluate("dispatchEvent(new Event('focus'))")
    expect(page.locator(".message")).to_contain_text("changed on disk")
    complete(page)
    assert card(page, "Result at") != before
    path.unlink()
    put(page, "2 um", "surface", "points", "file", "filter", "s")
    expect(page.locator(".row .error").first).to_contain_text("points.xyz")
    path.write_text(text)
    put(page, "", "surface", "points", "file", "filter", "s")
    complete(page)
    assert card(page, "Result at") == before


def test_a_server_that_is_killed_and_started_again(server, visit):
    save(server, POPULATION, "population")
    page = visit(server.address, expected=GONE)
    open_spec(page, "A population")
    complete(page)
    before = card(page, "Result at")
    server.end(signal.SIGKILL)
    put(page, "60 nm", "surface", "a", "population", "sigma")
    expect(page.locator(".status")).to_contain_text("experiment serve")
    server.start()
    put(page, "48 nm", "surface", "a", "population", "sigma")
    complete(page)
    assert card(page, "Result at") == before


def test_several_surfaces_stand_side_by_side(server, visit, tmp_path):
    page = visit(server.address)
    page.locator("input[type=file]").set_input_files(points(tmp_path))
    use(page)
    complete(page)
    page.locator("input[type=file]").set_input_files(text_of_heights(tmp_path))
    page.get_by_role("button", name="Put it beside").click()
    page.locator("input[name=pixel]").fill("1 um")
    use(page)
    complete(page)
    expect(page.locator(".heights canvas")).to_have_count(2)
    expect(page.locator(".case")).to_have_count(2)
    page.get_by_role("button", name="Remove heights").click()
    complete(page)
    expect(page.locator(".heights canvas")).to_have_count(1)


def test_a_profile_follows_the_line(server, visit, tmp_path):
    page = visit(server.address)
    page.locator("input[type=file]").set_input_files(points(tmp_path))
    use(page)
    complete(page)
    canvas = page.locator(".heights canvas")
    canvas.scroll_into_view_if_needed()
    box = canvas.bounding_box()
    before = page.locator(".heights line").get_attribute("x1")
    page.mouse.move(box["x"] + 0.2 * box["width"], box["y"] + 0.2 * box["height"])
    page.mouse.down()
    page.mouse.move(box["x"] + 0.8 * box["width"], box["y"] + 0.6 * box["height"])
    page.mouse.up()
    line = page.locator(".heights line")
    assert float(line.get_attribute("x1")) == pytest.approx(0.2, abs=0.02) != float(before)
    canvas.focus()
    canvas.press("r")
    canvas.press("ArrowRight")
    assert line.get_attribute("x1") == line.get_attribute("x2")


@pytest.mark.parametrize("scheme, width", [("light", 1280), ("dark", 400), pytest.param("light", 400, marks=full), pytest.param("dark", 1280, marks=full)])
def test_everyone_can_use_it(server, visit, width, scheme):
    """No serious fault by axe, no page wider than the screen, controls reached by the keyboard, the card heard."""
    save(server, POPULATION, "population")
    page = visit(server.address, width=width, color_scheme=scheme)
    page.locator(".entries").wait_for()

    def check():
        found = Axe().run(page).response["violations"]
        serious = [(one["id"], one["nodes"][0]["html"][:200]) for one in found if one["impact"] in ("serious", "critical")]
        assert not serious, serious
        assert page.evaluate("document.documentElement.scrollWidth") <= width

    check()
    entry = page.get_by_role("button", name="A population", exact=True)
    entry.focus()
    page.keyboard.press("Enter")
    complete(page)
    page.evaluate("document.querySelectorAll('.group').forEach(group => { group.open = true; })")
    check()
    heard = page.locator(".heard").inner_text()
    assert "May the integral replace the sum?" in heard and card(page, "Result at").split(":")[0] in heard
    control = key(page, "surface", "a", "population", "sigma")
    control.focus()
    for _ in range(2):
        page.keyboard.press("Tab")
        if page.evaluate("document.activeElement.type") == "range":
            break
    before = control.input_value()
    page.keyboard.press("ArrowRight")
    complete(page)
    assert control.input_value() != before
    help_ = page.get_by_role("button", name="Explain sigma")
    help_.focus()
    page.keyboard.press("Enter")
    expect(page.locator(".explanation:popover-open")).to_contain_text("surface.a.population.sigma")


@full
def test_the_tutorial_in_the_workbench(server, visit):
    """Part 3 of docs/tutorial.md: its steps, and the numbers that it quotes."""
    tutorial = (ROOT / "docs" / "tutorial.md").read_text().split("# Part 3")[1]
    shutil.copy(SURFACES / "opd-1.npy", server.folder / "shaft.npy")
    page = visit(server.address)
    page.get_by_role("button", name="shaft.npy").click()
    page.locator("input[name=pixel]").fill("196.733 nm")
    use(page)
    complete(page)
    key(page, "compare", "flat").select_option("steel-42CrMo4-QT")
    complete(page)
    assert "integral +95.8 %" in tutorial and "integral +95.8 %" in card(page, "Result at")
    assert "On this map: no" in card(page, "May the integral")
    page.get_by_role("button", name="Try filter").first.click()
    assert "3,176" in tutorial and "24,714" in tutorial
    expect(page.locator(".attempt")).to_contain_text("3,176 asperities")
    page.get_by_role("button", name="Discard").click()
    page.get_by_role("button", name="Keep").click()
    key(page, "compare", "kind-of-load").select_option("pressure")
    put(page, "10 MPa", "compare", "pressure")
    key(page, "compare", "layer", "material").select_option("coating-DLC")
    for thickness, share in (("200 nm", "77.5 %"), ("2 um", "80.9 %")):
        put(page, thickness, "compare", "layer", "thickness")
        complete(page)
        assert share in tutorial and f"{share} elastic" in card(page, "Result at"), thickness
    page.get_by_role("button", name="Keep").click()
    expect(page.locator(".kept tbody tr")).to_have_count(2)
