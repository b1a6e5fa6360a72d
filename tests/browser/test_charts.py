"""The charts of a comparison: values under the cursor, curves, units, axes, range, and what is saved."""

import csv
import io
import json
import re

import pytest
from conftest import REPORTS
from PIL import Image
from test_reports import serious_faults

REPORT = REPORTS / "measured-fine-finish" / "report.html"
FIGURE = "#fine-finish-models"
MAP = "#fine-finish-contact-map"
CURVE = "statistical − deterministic"
# Panels: three quantities, and below each its difference.
AREA, SEPARATION = 3, 4


@pytest.fixture
def page(open_page):
    page = open_page(REPORT)
    page.wait_for_selector(f"{FIGURE}.drawn canvas")
    return page


def hover(page, across, panel=AREA, figure=FIGURE):
    """Text under the cursor at a share of the width of a panel."""
    plot = page.locator(f"{figure} .u-over").nth(panel)
    plot.scroll_into_view_if_needed()
    box = plot.bounding_box()
    y = box["y"] + 0.5 * box["height"]
    # Two moves: charts take no notice of a mouse that they appear under.
    page.mouse.move(box["x"] + across * box["width"] - 1, y)
    page.mouse.move(box["x"] + across * box["width"], y)
    page.wait_for_timeout(100)
    values = plot.locator(".values")
    values.wait_for(state="visible")
    return values.inner_text()


def value(text, name=CURVE):
    return float(re.search(rf"{re.escape(name)}: (.*)", text)[1].replace("−", "-"))


def place(text):
    return float(re.match(r"at (.*)", text)[1].replace("−", "-"))


def near(a, b):
    """Whether four digits are the same."""
    return abs(a - b) <= 6e-4 * abs(b)


def separations():
    """Loads (MPa) and differences (sigma) between the models in the table of the report."""
    with open(REPORT.parent / "differences.csv", newline="", encoding="utf-8") as file:
        rows = [row for row in csv.DictReader(file) if row["quantity"] == "separation"]
    return [(1e-6 * float(row["pressure_pa"]), float(row["difference"])) for row in rows]


def test_hover_shows_the_value_of_the_table(page):
    table = separations()
    for across in (0.2, 0.4, 0.6):
        text = hover(page, across, panel=SEPARATION)
        load, difference = min(table, key=lambda row: abs(row[0] - place(text)))
        assert near(place(text), load) and near(value(text), difference)


def test_curves_switch_off_and_on(page):
    button = page.locator(f"{FIGURE} .names button", has_text=CURVE)
    assert CURVE in hover(page, 0.5)
    button.click()
    assert button.get_attribute("aria-pressed") == "false"
    plot = page.locator(f"{FIGURE} .u-over").nth(AREA)
    box = plot.bounding_box()
    page.mouse.move(box["x"] + 0.4 * box["width"], box["y"] + 20)
    # Only the interval is left; without it there is nothing under the cursor.
    assert CURVE not in plot.locator(".values").inner_text()
    page.locator(f"{FIGURE} .names button", has_text="95 % interval").click()
    page.mouse.move(box["x"] + 0.45 * box["width"], box["y"] + 20)
    assert not plot.locator(".values").is_visible()
    button.press("Enter")
    assert button.get_attribute("aria-pressed") == "true" and CURVE in hover(page, 0.5)


def test_units(page):
    selects = page.locator(f"{FIGURE} .tools select")
    labels = selects.nth(0).locator("option").all_inner_texts()
    assert any("MPa" in label for label in labels) and any("load ratio" in label for label in labels)
    selects.nth(0).select_option(label=next(label for label in labels if "(N)" in label))
    selects.nth(2).select_option(label="difference in separation (nm)")
    text = hover(page, 0.5, panel=SEPARATION)
    surface = json.loads((REPORT.parent / "summary.json").read_text())["surfaces"]["fine-finish"]
    newton, nanometre = 1e6 * surface["nominal_area_m2"], 1e9 * surface["sigma_m"]
    load, difference = min(separations(), key=lambda row: abs(row[0] * newton - place(text)))
    assert near(place(text), load * newton) and near(value(text), difference * nanometre)


def test_axes_zoom_and_whole_range(page):
    canvas = page.locator(f"{FIGURE} canvas").nth(AREA)
    linear = canvas.screenshot()
    at_middle = place(hover(page, 0.5))
    page.locator(f"{FIGURE} .tools label", has_text="log x").locator("input").click()
    assert place(hover(page, 0.5)) > 5 * at_middle
    page.locator(f"{FIGURE} .tools label", has_text="log x").locator("input").click()
    assert place(hover(page, 0.5)) == at_middle
    box = page.locator(f"{FIGURE} .u-over").nth(AREA).bounding_box()
    middle = box["y"] + 0.5 * box["height"]
    page.mouse.move(box["x"] + 0.6 * box["width"], middle)
    page.mouse.down()
    page.mouse.move(box["x"] + 0.8 * box["width"], middle, steps=5)
    page.mouse.up()
    assert place(hover(page, 0.5)) > 1.5 * at_middle
    page.locator(f"{FIGURE} .tools button", has_text="Whole range").click()
    assert place(hover(page, 0.5)) == at_middle
    page.mouse.move(0, 0)
    assert canvas.screenshot() == linear


def test_data_are_copied(page):
    page.locator(f"{FIGURE} .tools button", has_text="Copy CSV").click()
    page.wait_for_function(f"document.querySelector('{FIGURE} .said').textContent === 'copied'")
    copied = list(csv.DictReader(io.StringIO(page.evaluate("navigator.clipboard.readText()"))))
    shown = [row for row in copied if row["panel"] == "difference in separation (σ)" and row["curve"] == CURVE]
    table = separations()
    assert len(shown) == len(table)
    for row, (load, difference) in zip(shown, table):
        assert abs(float(row["x"]) - load) <= 1e-5 * load
        assert abs(float(row["y"]) - difference) <= 1e-5 * abs(difference)


def test_figures_are_saved(page):
    for kind in ("SVG", "PNG"):
        with page.expect_download() as download:
            page.locator(f"{FIGURE} .tools button", has_text=f"Save {kind}").click()
        assert download.value.suggested_filename == f"fine-finish-models.{kind.lower()}"
        content = download.value.path().read_bytes()
        if kind == "SVG":
            assert content.startswith(b"<svg") and b"Separation" in content
        else:
            picture = Image.open(io.BytesIO(content)).convert("RGB")
            assert picture.width > 1000 and len(picture.getcolors(1 << 24)) > 50


def test_keyboard(page):
    reached = []
    # Terms that are explained come before the first chart.
    for _ in range(60):
        page.keyboard.press("Tab")
        reached.append(page.evaluate("document.activeElement.tagName"))
    assert {"BUTTON", "SELECT", "INPUT", "SUMMARY"} <= set(reached), reached
    page.locator("summary").first.focus()
    page.keyboard.press("Enter")
    assert page.locator("details").first.get_attribute("open") is not None


def test_differences_are_shown_with_their_zero(open_page):
    page = open_page(REPORT)
    page.add_init_script(
        """const write = CanvasRenderingContext2D.prototype.fillText;
        CanvasRenderingContext2D.prototype.fillText = function (text, ...rest) {
            this.canvas.written = [...(this.canvas.written || []), text];
            write.call(this, text, ...rest);
        };"""
    )
    page.reload()
    page.wait_for_selector(f"{FIGURE}.drawn canvas")
    ticks = page.locator(f"{FIGURE} canvas").evaluate_all("all => all.map(canvas => canvas.written)")
    assert len(ticks) == 6 and all("0" in written for written in ticks[AREA:]), ticks


def test_points_at_one_place_are_all_there(open_page, tmp_path):
    """Three points of a curve at each place instead of one."""
    text = REPORT.read_text(encoding="utf-8")
    start, end = re.search(r'<script type="application/json">(.*?)</script>', text, re.DOTALL).span(1)
    data = json.loads(text[start:end])
    panel = data["panels"][SEPARATION]
    curve = next(series for series in panel["series"] if series["name"] == CURVE)
    panel["places"].append([place for place in panel["places"][curve["x"]] for _ in range(3)])
    curve["x"] = len(panel["places"]) - 1
    curve["y"] = [value + shift for value in curve["y"] for shift in (0, 1, 2)]
    path = tmp_path / "report.html"
    path.write_text(text[:start] + json.dumps(data) + text[end:], encoding="utf-8")
    page = open_page(path)
    page.wait_for_selector(f"{FIGURE}.drawn canvas")
    values = re.search(rf"{re.escape(CURVE)}: (.*)", hover(page, 0.5, panel=SEPARATION))[1].replace("−", "-").split(", ")
    first = float(values[0])
    assert [round(float(each) - first) for each in values] == [0, 1, 2], values


@pytest.mark.parametrize("width", [1280, 400])
@pytest.mark.parametrize("scheme", ["light", "dark"])
def test_the_slider_moves_the_patches(open_page, width, scheme):
    page = open_page(REPORT, width=width, color_scheme=scheme)
    page.wait_for_selector(f"{FIGURE}.drawn canvas")
    page.locator(MAP).scroll_into_view_if_needed()
    slider = page.get_by_role("slider", name="load")
    slider.wait_for()
    patches = page.locator(f"{MAP} .patches")
    shown = [(patches.inner_html(), slider.get_attribute("aria-valuetext"))]
    assert page.locator(f"{MAP} .frame-name").text_content().strip() == shown[0][1]
    slider.focus()
    for key in ("ArrowRight", "End", "Home"):
        page.keyboard.press(key)
        shown.append((patches.inner_html(), slider.get_attribute("aria-valuetext")))
        assert page.locator(f"{MAP} output").inner_text() == shown[-1][1]
        assert page.locator(f"{MAP} .frame-name").text_content().strip() == shown[-1][1]
    assert len({picture for picture, _ in shown}) == 4 and all("of the area" in name for _, name in shown)
    contacts = [int(re.search(r"([\d,]+) contacts", name)[1].replace(",", "")) for _, name in shown]
    assert contacts[3] < contacts[0] < contacts[1] < contacts[2], contacts
    box = slider.bounding_box()
    assert box["x"] >= 0 and box["x"] + box["width"] <= width
    assert not serious_faults(page)
