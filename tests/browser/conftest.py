"""Reports in a headless Chromium."""

import os
import pathlib
import shutil

import pytest
from playwright.sync_api import sync_playwright

REPORTS = pathlib.Path(os.environ.get("REPORTS", pathlib.Path(__file__).parents[2] / "reports"))


def pages():
    """All pages of the reports, and those that lead to them."""
    return [REPORTS / "index.html", *sorted(REPORTS.glob("*/report.html"))]


def pytest_generate_tests(metafunc):
    if "report" in metafunc.fixturenames:
        metafunc.parametrize("report", pages(), ids=lambda path: str(path.relative_to(REPORTS)))


@pytest.fixture(scope="session")
def browser():
    program = shutil.which("chromium") or shutil.which("chromium-browser") or shutil.which("google-chrome")
    with sync_playwright() as playwright:
        browser = playwright.chromium.launch(executable_path=program, args=["--no-sandbox"])
        yield browser
        browser.close()


@pytest.fixture
def open_page(browser):
    """Opens a file and returns its page, which must report no error until the test ends."""
    contexts, errors = [], []

    def opened(path, width=1280, height=800, **options):
        permissions = [] if options.get("java_script_enabled") is False else ["clipboard-read", "clipboard-write"]
        context = browser.new_context(viewport={"width": width, "height": height}, permissions=permissions, **options)
        contexts.append(context)
        page = context.new_page()
        page.on("pageerror", lambda error: errors.append(str(error)))
        page.on("console", lambda message: errors.append(message.text) if message.type in ("error", "warning") else None)
        page.goto(path.resolve().as_uri())
        return page

    yield opened
    for context in contexts:
        context.close()
    assert not errors, errors
