"""The index of the reports, and the page that overlays curves of several."""

from conftest import REPORTS


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


def test_every_card_has_a_picture(open_page):
    page = open_page(REPORTS / "index.html")
    pictures = page.locator(".cards img")
    assert pictures.count() >= page.locator(".cards li").count() / 2
    for picture in pictures.all():
        picture.scroll_into_view_if_needed()
    page.wait_for_function("[...document.images].every(one => one.naturalWidth > 0)")


def test_curves_of_several_reports(open_page):
    page = open_page(REPORTS / "comparison.html")
    names = page.locator(".names button")
    before = names.count()
    assert before >= 2
    page.locator("#words").fill("lead-on-steel bulk")
    box = page.locator(".cases tr:visible input").first
    box.check()
    assert names.count() == before + 1
    assert any("bulk" in name for name in names.all_inner_texts())
    address = page.url
    page.locator("#along").select_option("1")
    assert "load ratio" in page.locator(".along-x").first.inner_text()
    # The address holds the choice.
    page.goto("about:blank")
    page.goto(address)
    assert page.locator(".names button").count() == before + 1
