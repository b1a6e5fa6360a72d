"""What holds for every page of the reports."""

import io

import pytest
from axe_playwright_python.sync_playwright import Axe
from conftest import REPORTS
from PIL import Image

LARGEST = 1_500_000


def draw_all(page):
    """Scrolls through the page, with all details open, so that every chart is made."""
    page.evaluate("""async () => {
        for (const one of document.querySelectorAll("details")) one.open = true;
        for (const figure of document.querySelectorAll("figure")) {
            figure.scrollIntoView();
            await new Promise(done => requestAnimationFrame(() => requestAnimationFrame(done)));
        }
        scrollTo(0, 0);
    }""")
    drawn = "figure:has(> script[type='application/json'])"
    # A map keeps its picture, and has a slider.
    assert page.locator(f"{drawn}:not(.drawn, :has(.slider), :has(.patches))").count() == 0


def colours(picture):
    """Number of colours of a screenshot; a blank one has a single one."""
    return len(Image.open(io.BytesIO(picture)).convert("RGB").getcolors(1 << 24))


def serious_faults(page, **options):
    """What axe-core finds to keep people out."""
    # The elements of a picture are read as one image.
    pictures = {"exclude": [[".picture > svg > *"]]}
    # What it finds in order, it need not describe.
    options = {"resultTypes": ["violations"], **options}
    found = Axe().run(page, context=pictures, options=options).response["violations"]
    serious = [one for one in found if one["impact"] in ("serious", "critical")]
    return [(one["id"], one["nodes"][0]["html"], one["nodes"][0]["failureSummary"]) for one in serious]


def test_page(report, open_page):
    assert report.stat().st_size < LARGEST
    page = open_page(report)
    draw_all(page)
    assert page.title()
    assert colours(page.screenshot()) > 10
    blank = page.evaluate("""[...document.querySelectorAll("figure canvas")].filter(canvas => {
        const { width, height } = canvas;
        const pixels = new Uint32Array(canvas.getContext("2d").getImageData(0, 0, width, height).data.buffer);
        return new Set(pixels).size < 6;
    }).map(canvas => canvas.closest("figure").id)""")
    assert not blank
    for picture in page.query_selector_all("figure .picture > svg"):
        title = picture.query_selector("title")
        assert picture.get_attribute("role") == "img" and title and title.text_content().strip()
    assert not serious_faults(page)
    page.emulate_media(media="print")
    assert page.locator(".chart:visible").count() == 0
    if page.locator("figure .picture").count() > 0:
        assert page.locator("figure .picture").first.is_visible()


# The colours are those of all pages.
@pytest.mark.parametrize("name", ["index.html", "measured-fine-finish/report.html", "laws/report.html"])
def test_dark(name, open_page):
    page = open_page(REPORTS / name, color_scheme="dark")
    draw_all(page)
    assert not serious_faults(page, runOnly=["color-contrast"])


def test_nothing_overflows_at_400_pixels(report, open_page):
    page = open_page(report, width=400)
    draw_all(page)
    assert page.evaluate("document.documentElement.scrollWidth") <= 400


def test_without_script(report, open_page):
    page = open_page(report, width=400, java_script_enabled=False)
    assert page.locator("body").bounding_box()["width"] <= 400
    # A window that scrolls sideways moves when it is told to.
    page.mouse.wheel(200, 0)
    page.wait_for_timeout(100)
    assert page.locator("body").bounding_box()["x"] == 0
    if page.locator("figure .picture").count() > 0:
        assert page.locator("figure .picture").first.is_visible()
