"""An atlas on the viewer's page: a sheet of thumbnails with a search, and names to copy."""

import math
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from viewed import ready, value
from viewer_page import FIT, manifest, write_page
from waiting import drawn

import vexture

COUNT = 1100


def star(place: int) -> Any:
    """A star of its own: of 3 to 11 points, of 11 depths."""
    points, inner = 3 + place % 9, 0.18 + 0.02 * (place * 7 % 11)
    turns = [(math.pi * k / points, 0.45 if k % 2 == 0 else inner) for k in range(2 * points)]
    corners = [(0.5 + reach * math.sin(turn), 0.5 + reach * math.cos(turn)) for turn, reach in turns]
    return replace(vexture.Drawing.polygon(corners), name=f"Star/{place:04d} of {points}")


@pytest.fixture(scope="module")
def stars(tmp_path_factory: pytest.TempPathFactory) -> tuple[Any, str]:
    """An atlas of more than a thousand stars, and its page."""
    atlas = vexture.atlas([star(place) for place in range(COUNT)], name="stars")
    page = write_page(tmp_path_factory.mktemp("stars") / "stars.html", manifest(atlas))
    return atlas, page.as_uri()


def cells(page: Any) -> Any:
    return page.get_by_role("list", name="Drawings").get_by_role("listitem")


def thumbnail(page: Any, place: int) -> Any:
    """Opacity of a thumbnail's ink, once it is drawn: it is black on white."""
    canvas = f".sheet li[data-place='{place}'] canvas"
    # a canvas is 300 pixels wide before anything is drawn
    page.wait_for_function("(which) => ![300, undefined].includes(document.querySelector(which)?.width)", arg=canvas)
    levels, side = page.evaluate(
        """(which) => {
          const canvas = document.querySelector(which);
          const { data } = canvas.getContext('2d').getImageData(0, 0, canvas.width, canvas.height);
          return [[...data].filter((_, i) => i % 4 === 0), canvas.width];
        }""",
        canvas,
    )
    return 1.0 - np.array(levels).reshape(side, side) / 255


def expected(atlas: Any, place: int, side: int) -> Any:
    step = 1 / (FIT * side)
    low = 0.5 - side / 2 * step
    return atlas.coverage(side, np.array([[step, 0, low], [0, -step, 1 - low]]), root=place)


def test_thumbnails_are_the_drawings_and_only_those_that_are_seen_are_there(
    stars: tuple[Any, str], open_page: Callable[..., Any], screenshot: Callable[..., Path]
) -> None:
    atlas, url = stars
    page = ready(open_page, url, (900, 600))
    assert page.locator(".sheet-count").inner_text() == f"{COUNT:,}"
    for place in (0, 5):
        found = thumbnail(page, place)
        assert np.abs(found - expected(atlas, place, len(found))).max() <= 2 / 255
    assert 10 < cells(page).count() < 40
    screenshot(page)
    for top in (3000, 6000, 1e9):
        page.evaluate("(top) => { document.querySelector('.sheet-scroll').scrollTop = top; }", top)
        drawn(page)
    found = thumbnail(page, COUNT - 1)
    assert np.abs(found - expected(atlas, COUNT - 1, len(found))).max() <= 2 / 255
    assert cells(page).count() < 40
    assert cells(page).last.get_attribute("aria-posinset") == str(COUNT)


def test_names_are_searched_opened_and_copied(stars: tuple[Any, str], open_page: Callable[..., Any]) -> None:
    page = ready(open_page, stars[1], (900, 600), permissions=["clipboard-read", "clipboard-write"])
    search = page.get_by_role("searchbox", name="Search names")
    search.fill("NO star")
    page.get_by_text(f"0 of {COUNT:,}", exact=True).wait_for()
    search.fill("of 007 STAR")  # all words, in any case
    page.get_by_text(f"of {COUNT:,}").wait_for()
    places = [place for place in range(COUNT) if "007" in star(place).name]
    page.wait_for_function("(count) => document.querySelectorAll('.sheet li').length === count", arg=len(places))
    wanted = star(places[1]).name
    page.get_by_role("button", name=f"Copy the name {wanted}", exact=True).click()
    page.get_by_role("status").filter(has_text=f"{wanted} is copied.").wait_for()
    assert page.evaluate("navigator.clipboard.readText()") == wanted
    page.get_by_role("button", name=wanted, exact=True).click()
    page.get_by_role("region", name="All drawings").wait_for(state="hidden")
    assert value(page)["drawing"] == wanted
    assert page.evaluate("vexture.viewer.engine.drawing.first") == places[1]
    page.get_by_role("button", name="All drawings").click()
    page.get_by_role("region", name="All drawings").wait_for()
    assert search.input_value() == "of 007 STAR"
    assert page.evaluate("document.activeElement.title") == wanted


def test_the_sheet_is_used_by_keys(stars: tuple[Any, str], open_page: Callable[..., Any]) -> None:
    page = ready(open_page, stars[1], (900, 600))
    page.get_by_role("searchbox").press("ArrowDown")
    place = "Number(document.activeElement.closest('li').dataset.place)"
    assert page.evaluate(place) == 0
    page.keyboard.press("ArrowRight")
    page.keyboard.press("ArrowDown")
    columns = page.evaluate(place) - 1
    assert columns >= 3
    page.keyboard.press("End")
    assert page.evaluate(place) == COUNT - 1
    assert page.evaluate("document.querySelector('.sheet-scroll').scrollTop") > 1000
    page.keyboard.press("Home")
    page.keyboard.press("4")  # the letter is searched for
    assert page.get_by_role("searchbox").input_value() == "4"
    page.keyboard.press("Enter")
    page.get_by_role("region", name="All drawings").wait_for(state="hidden")
    assert value(page)["drawing"] == next(name for place in range(COUNT) if "4" in (name := star(place).name))


def test_a_link_leads_to_one_drawing_and_the_sheet_fits_a_phone(
    stars: tuple[Any, str], open_page: Callable[..., Any], screenshot: Callable[..., Path]
) -> None:
    link = "#view=1~~Star%2F0007 of 10~0.5~0.5~1~flat~0~0~1~dark~~0.5~0~0"
    page = ready(open_page, stars[1] + link, (390, 844), has_touch=True, is_mobile=True)
    assert not page.get_by_role("region", name="All drawings").is_visible()
    page.get_by_role("button", name="All drawings").tap()
    thumbnail(page, 0)
    drawn(page)
    screenshot(page)
    sheet = page.get_by_role("region", name="All drawings")
    for button in sheet.get_by_role("button").all()[:6]:
        box = button.bounding_box()
        assert min(box["width"], box["height"]) >= 44
        assert box["x"] + box["width"] <= 390
    assert page.evaluate("document.documentElement.scrollWidth") <= 390
