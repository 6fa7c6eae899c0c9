"""Coordinate systems inside nested viewports, and the names of elements there."""

import numpy as np
import pytest

from vexture.base.errors import SourceError
from vexture.svg.outline import ShapeOutline
from vexture.svg.space import MOST_MASKS, ContentWindow, ElementPlace, Space
from vexture.svg.transform import Identity
from vexture.svg.values import TooLargeError, Viewport

SQUARE = ShapeOutline.rectangle(0.0, 0.0, 1.0, 1.0).loop
PLACE = ElementPlace(Viewport(100.0, 50.0), Space())


def box(contour: np.ndarray) -> list[float]:
    return [*contour.min(axis=(0, 1)), *contour.max(axis=(0, 1))]


def test_transforms_apply_from_the_inside() -> None:
    space = Space().with_transform(Identity.translate(10.0, 0.0)).with_transform(Identity.scale(2.0))
    assert box(space.to_drawing(SQUARE)) == [10.0, 0.0, 12.0, 2.0]
    assert space.whole == Identity.translate(10.0, 0.0).scale(2.0)


def test_a_window_cuts_what_reaches_beyond_it() -> None:
    outer = Space().with_transform(Identity.translate(10.0, 20.0))
    inner = outer.window((0.0, 0.0, 4.0, 4.0), Identity.scale(3.0))
    assert box(inner.to_drawing(2.0 * SQUARE)) == [10.0, 20.0, 14.0, 24.0]
    beside = inner.with_transform(Identity.translate(2.0, 0.0))
    assert len(beside.to_drawing(SQUARE)) == 0
    assert inner.whole == Identity.translate(10.0, 20.0).scale(3.0)


def test_space_without_area_is_flat() -> None:
    assert not Space().flat
    assert Space().with_transform(Identity.scale(1.0, 0.0)).flat
    assert not Space().with_transform(Identity.scale(1e-6)).flat


def test_transforms_that_multiply_to_too_much_are_refused() -> None:
    with pytest.raises(TooLargeError, match=r"multiply to 1e\+14; the limit is 1e\+12"):
        Space().with_transform(Identity.scale(1e7)).with_transform(Identity.scale(1e7))


def test_what_a_use_shows_has_one_name() -> None:
    assert PLACE.named("a", False) == ("a", False)
    assert PLACE.named("a", True) == ("a", True)
    inside = ElementPlace(PLACE.viewport, PLACE.space, name="u", is_instance=True)
    assert inside.named("a", False) == ("u", True)
    group = ElementPlace(PLACE.viewport, PLACE.space, name="g")
    assert group.named("", True) == ("g", False)


def test_masks_have_a_deepest_level() -> None:
    assert PLACE.deeper() == 1
    deepest = ElementPlace(PLACE.viewport, PLACE.space, masks=MOST_MASKS)
    with pytest.raises(SourceError, match=f"are nested more than {MOST_MASKS} deep"):
        deepest.deeper()


def test_percentages_in_a_window_refer_to_its_size() -> None:
    for visible in (None, (0.0, 0.0, 1.0, 1.0)):
        inner = ContentWindow(visible, Identity.scale(2.0), (8.0, 6.0)).within(PLACE)
        assert (inner.viewport.width, inner.viewport.height) == (8.0, 6.0)
        assert inner.space.clip == visible
        assert inner.space.whole == Identity.scale(2.0)
