"""The index of the reports, the page that overlays curves of several, and terms that are explained."""

import re

import pytest
from conftest import REPORTS

GROUPS = ["Your surfaces", "The paper", "Layers", "Conductance and friction", "Laws", "Why the models differ", "Reality check", "How far to trust the program"]
SMALLEST = 9


def test_cards_are_filtered(open_page):
    page = open_page(REPORTS / "index.html")
    cards = page.locator(".cards li")
    assert cards.count() == len(list(REPORTS.glob("*/summary.json")))
    page.locator("#kind").select_option("laws")
    assert page.locator(".cards li:visible").count() == 1
    page.locator("#kind").select_option("")
    page.locator("#surface").select_option("fine-finish")
    assert 1 < page.locator(".cards li:visible").count() < cards.count()
    page.locator("#words").fill("coating nickel")
    assert page.locator(".cards li:visible").count() == 1


def test_cards_are_grouped(open_page):
    page = open_page(REPORTS / "index.html")
    titles = page.locator("main > section > h2").all_inner_texts()
    assert len(titles) > 2 and titles == [title for title in GROUPS if title in titles]
    assert page.locator("main > section .cards li").count() == page.locator(".cards li").count()
    for section in page.locator("main > section").all():
        assert section.locator("li").count() > 0
    page.locator("#kind").select_option("laws")
    assert page.locator("main > section:visible h2").all_inner_texts() == ["Laws"]


@pytest.mark.parametrize("width", [1280, 400])
def test_every_card_has_a_picture_that_can_be_read(open_page, width):
    page = open_page(REPORTS / "index.html", width=width)
    pictures = page.locator(".cards img")
    assert pictures.count() >= page.locator(".cards li").count() / 2
    for picture in pictures.all():
        picture.scroll_into_view_if_needed()
    page.wait_for_function("[...document.images].every(one => one.naturalWidth > 0)")
    for picture in pictures.all():
        svg = (REPORTS / picture.get_attribute("src")).read_text(encoding="utf-8")
        across = float(re.search(r'viewBox="0 0 (\S+) ', svg)[1])
        scale = picture.bounding_box()["width"] / across
        sizes = [scale * float(size) for size in re.findall(r'font-size="([\d.]+)"', svg)]
        assert sizes and min(sizes) >= SMALLEST, (picture.get_attribute("src"), min(sizes))


def test_every_card_has_an_answer(open_page):
    page = open_page(REPORTS / "index.html")
    for card in page.locator(".cards li").all():
        assert card.locator(".answer").inner_text().strip(), card.inner_text()


@pytest.mark.parametrize("width", [1280, 400])
def test_numbers_along_axes_do_not_overlap(open_page, width):
    page = open_page(REPORTS / "measured-fine-finish/report.html", width=width)
    page.add_init_script(
        """const write = CanvasRenderingContext2D.prototype.fillText;
        CanvasRenderingContext2D.prototype.fillText = function (text, x, y, ...rest) {
            const half = this.measureText(text).width / 2;
            if (this.textAlign === "center") (this.canvas.written ||= []).push([y, x - half, x + half, text]);
            write.call(this, text, x, y, ...rest);
        };
        const clear = CanvasRenderingContext2D.prototype.clearRect;
        CanvasRenderingContext2D.prototype.clearRect = function (...all) {
            this.canvas.written = [];
            clear.apply(this, all);
        };"""
    )
    page.reload()
    page.wait_for_selector(".chart canvas")
    page.wait_for_timeout(300)
    for written in page.locator(".chart canvas").evaluate_all("all => all.map(one => one.written)"):
        along = sorted(one for one in written if one[0] == written[0][0])
        assert len(along) > 1
        for (_, _, end, left), (_, start, _, right) in zip(along, along[1:]):
            assert end + 2 < start, (left, right)


@pytest.fixture
def terms(open_page):
    """The first report with a term that is explained outside of folded details."""
    for report in sorted(REPORTS.glob("*/report.html")):
        if '<button type="button" class="term"' in report.read_text(encoding="utf-8"):
            page = open_page(report)
            if page.locator(".term:visible").count() > 0:
                return page
    pytest.fail("no page explains a term")


def test_a_term_is_explained_on_hover_focus_and_touch(terms):
    term = terms.locator(".term:visible").first
    meaning = terms.locator(f"#{term.get_attribute('aria-describedby')}")
    assert not meaning.is_visible()
    term.hover()
    meaning.wait_for(state="visible")
    box = meaning.bounding_box()
    assert box["x"] >= 0 and box["x"] + box["width"] <= 1280 and len(meaning.inner_text()) > 20
    terms.mouse.move(0, 0)
    meaning.wait_for(state="hidden")
    term.focus()
    meaning.wait_for(state="visible")
    terms.keyboard.press("Escape")
    meaning.wait_for(state="hidden")
    term.click()
    meaning.wait_for(state="visible")


def test_a_term_is_explained_without_script(open_page, terms):
    """A click opens what it means."""
    from urllib.parse import unquote, urlparse
    from pathlib import Path

    page = open_page(Path(unquote(urlparse(terms.url).path)), java_script_enabled=False)
    term = page.locator(".term:visible").first
    term.click()
    assert page.locator(f"#{term.get_attribute('aria-describedby')}").is_visible()
