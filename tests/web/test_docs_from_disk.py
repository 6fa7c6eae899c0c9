"""The documentation as people read it: from the disk, searched, on a screen and on a phone, without a network."""

from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest
from waiting import drawn

pytest.importorskip("mkdocs", reason="MkDocs is not installed (pip install '.[docs]')")


# those that would wait until they are seen, too
BROKEN = """async () => {
  const ended = (image) => new Promise((resolve) => {
    image.loading = 'eager'
    if (image.complete) resolve()
    image.onload = image.onerror = resolve
  })
  await Promise.all([...document.images].map(ended))
  return [...document.images].filter(({ naturalWidth }) => !naturalWidth).map(({ src }) => src.slice(0, 99))
}"""


@pytest.mark.long
@pytest.mark.parametrize(
    ("width", "step"), [(390, 3), *(pytest.param(width, 1, marks=pytest.mark.slow) for width in (390, 1280))]
)
def test_pages_fit_and_fetch_nothing(site: Path, open_page: Callable[..., Any], width: int, step: int) -> None:
    """All guides, and of the others one in so many."""
    page = open_page(f"file://{site}/index.html", (width, 800))
    asked: list[str] = []
    page.on("request", lambda request: asked.append(request.url))
    pages = [path for path in sorted(site.rglob("*.html")) if path.name != "404.html"]
    for path in [path for number, path in enumerate(pages) if number % step == 0 or path.parent.name == "guides"]:
        page.goto(f"file://{path}")
        assert page.evaluate(BROKEN) == [], path.name
        drawn(page)
        wide = page.evaluate("document.documentElement.scrollWidth")
        assert wide <= width, f"{path.name} is {wide} pixels wide on a screen of {width}"
    assert [address for address in asked if not address.startswith(("file:", "data:"))] == []
    assert len(asked) > 20


def test_search_works_from_the_disk(site: Path, open_page: Callable[..., Any]) -> None:
    page = open_page(f"file://{site}/guides/coastal-data.html", (1280, 800))
    page.click("[data-md-component=search-query]")
    page.keyboard.type("shore_fold amplitude")
    page.wait_for_selector(".md-search-result__link")
    found = page.eval_on_selector_all(".md-search-result__link", "links => links.map(({ href }) => href)")
    assert any("floods-and-folds.html" in address for address in found[:3])
    page.click(".md-search-result__link")
    page.wait_for_url("**/reference/**")
