"""The badge of the viewer's page that says how the picture differs from its source."""

from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest
from overlay_page import NOTES, Shown
from waiting import drawn

MARGIN = 4.0
"""Pixels between what is drawn and its mark."""


def marks(shown: Shown) -> list[list[float]]:
    """Left, top, right and bottom of each mark, on the page."""
    found = [mark.bounding_box() for mark in shown.page.locator("rect.difference").all()]
    return [[box["x"], box["y"], box["x"] + box["width"], box["y"] + box["height"]] for box in found]


def expected(shown: Shown) -> list[list[float]]:
    """The same by the notes; a stroke of two pixels lies around each box."""
    made = []
    for left, bottom, right, top in (subject.box for note in NOTES for subject in note.elements if subject.box):
        (x, y), (ex, ey) = shown.point(left, top), shown.point(right, bottom)
        made.append([x - MARGIN, y - MARGIN, ex + MARGIN, ey + MARGIN])
    return made


def test_the_badge_opens_the_list_and_marks_what_is_drawn(
    show: Callable[..., Shown], screenshot: Callable[..., Path]
) -> None:
    shown = show("duck")
    badge = shown.page.get_by_role("button", name="differs from the source: filter of blur (2), gradient mesh")
    rows = shown.page.get_by_role("list", name="Differences")
    assert badge.get_attribute("aria-expanded") == "false"
    assert not rows.is_visible()
    assert marks(shown) == []
    badge.press("Enter")
    assert badge.get_attribute("aria-expanded") == "true"
    assert rows.inner_text().split("\n") == [
        *("Left out filter of blur (2)", "bill", "eye"),
        *("Simplified gradient mesh", "water, not drawn"),
    ]
    for center, zoom in (((0.5, 0.5), 1.0), ((0.3, 0.6), 2.0)):
        shown.look(center, zoom)
        drawn(shown.page)
        assert np.array(marks(shown)) == pytest.approx(np.array(expected(shown)), abs=2.0)
    screenshot(shown.page)
    shown.page.get_by_role("button", name="bill", exact=True).click()
    assert shown.page.evaluate("vexture.viewer.state.value.center") == pytest.approx([0.2, 0.6])
    assert shown.page.locator("rect.difference.chosen").count() == 1
    shown.page.keyboard.press("Escape")
    assert not rows.is_visible()
    assert badge.evaluate("badge => badge === document.activeElement")
    assert marks(shown) == []


def test_no_badge_where_nothing_differs(show: Callable[..., Shown]) -> None:
    shown = show("ocean")
    assert shown.page.locator(".badge").count() == 1
    assert not shown.page.locator(".badge").is_visible()
