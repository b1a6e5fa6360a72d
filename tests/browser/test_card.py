"""The first screen of a page: the card or the sentence, and the verdict map."""

import os
from pathlib import Path

import pytest

REPORTS = Path(os.environ["REPORTS"])
PAGES = sorted(REPORTS.glob("*/report.html"))
SCREENS = [(1280, 800), (400, 800)]


@pytest.mark.parametrize("screen", SCREENS, ids=["wide", "narrow"])
@pytest.mark.parametrize("path", PAGES, ids=lambda path: path.parent.name)
def test_the_answer_is_on_the_first_screen(browser, path, screen):
    page = browser.new_page(viewport={"width": screen[0], "height": screen[1]})
    page.goto(path.as_uri())
    answers = page.locator(".card, .lead")
    bottom = max(answers.nth(k).bounding_box()["y"] + answers.nth(k).bounding_box()["height"] for k in range(answers.count()))
    page.close()
    assert bottom <= screen[1], bottom


def test_lines_of_a_card_are_short(browser):
    page = browser.new_page()
    page.goto((REPORTS / "measured-fine-finish" / "report.html").as_uri())
    lines = page.locator(".card > div")
    assert 1 <= lines.count() <= 7
    texts = page.locator(".card dd > p").all_inner_texts()
    page.close()
    assert texts and max(len(text.split()) for text in texts) <= 25, texts


@pytest.mark.parametrize("screen", SCREENS, ids=["wide", "narrow"])
@pytest.mark.parametrize("name", ["heights-of-one-spectrum", "thickness-of-a-soft-coating", "joint-density"])
def test_labels_of_a_verdict_map_can_be_read(browser, name, screen):
    page = browser.new_page(viewport={"width": screen[0], "height": screen[1]})
    page.goto((REPORTS / name / "report.html").as_uri())
    # The height of a letter on the screen, not in the units of the picture.
    sizes = page.locator("figure[id$=verdicts] svg").first.evaluate(
        """svg => [...svg.querySelectorAll('text')].map(text => {
            const size = parseFloat(getComputedStyle(text).fontSize);
            return size * svg.getBoundingClientRect().width / svg.viewBox.baseVal.width;
        })"""
    )
    page.close()
    assert len(sizes) > 10 and min(sizes) >= 9, min(sizes, default=None)
