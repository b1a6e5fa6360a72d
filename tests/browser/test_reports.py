"""What holds for every page of the reports."""

import io

import pytest
from axe_playwright_python.sync_playwright import Axe
from PIL import Image

LARGEST = 1_500_000


def draw_all(page):
    """Scrolls through the page, with all details open, so that every chart is made."""
    page.evaluate("document.querySelectorAll('details').forEach(one => { one.open = true; })")
    for figure in page.query_selector_all("figure"):
        figure.scroll_into_view_if_needed()
    page.wait_for_timeout(200)
    page.evaluate("scrollTo(0, 0)")


def colours(picture):
    """Number of colours of a screenshot; a blank one has a single one."""
    return len(Image.open(io.BytesIO(picture)).convert("RGB").getcolors(1 << 24))


def test_size(report):
    assert report.stat().st_size < LARGEST


def test_no_error_and_nothing_blank(report, open_page):
    page = open_page(report)
    draw_all(page)
    assert page.title()
    assert colours(page.screenshot()) > 10
    for chart in page.query_selector_all("figure.drawn canvas"):
        assert colours(chart.screenshot()) > 5, chart.evaluate("one => one.closest('figure').id")


@pytest.mark.parametrize("script", [True, False], ids=["script", "no-script"])
def test_nothing_overflows_at_400_pixels(report, open_page, script):
    page = open_page(report, width=400, java_script_enabled=script)
    if script:
        draw_all(page)
        assert page.evaluate("document.documentElement.scrollWidth") <= 400
    else:
        # A window that scrolls sideways moves when it is told to.
        page.mouse.wheel(200, 0)
        page.wait_for_timeout(100)
        assert page.locator("body").bounding_box()["x"] == 0
    assert page.locator("body").bounding_box()["width"] <= 400


@pytest.mark.parametrize("scheme", ["light", "dark"])
def test_accessible(report, open_page, scheme):
    page = open_page(report, color_scheme=scheme)
    draw_all(page)
    found = Axe().run(page).response["violations"]
    serious = [one for one in found if one["impact"] in ("serious", "critical")]
    assert not serious, [(one["id"], one["nodes"][0]["html"], one["nodes"][0]["failureSummary"]) for one in serious]


def test_figures_say_what_they_show(report, open_page):
    page = open_page(report)
    for figure in page.query_selector_all("figure"):
        picture = figure.query_selector(".picture > svg")
        title = picture.query_selector("title")
        assert picture.get_attribute("role") == "img" and title and title.text_content().strip()


def test_pictures_without_script_and_in_print(report, open_page):
    for page in (open_page(report, java_script_enabled=False), open_page(report)):
        if page.locator("figure").count() == 0:
            continue
        page.emulate_media(media="print")
        first = page.locator("figure .picture").first
        assert first.is_visible() and page.locator(".chart:visible").count() == 0
