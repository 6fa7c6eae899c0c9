"""Elements of a planar map that can be restyled, and what its paints are made of."""

import numpy as np
import pytest

from degenerate import polygon
from vexture.base.errors import LimitError, SourceError
from vexture.drawing.drawing import Drawing, Path
from vexture.drawing.group import Group, Mask
from vexture.drawing.paint import Gradient, Paint, Stop
from vexture.tree.planar.style import PlanarStyle, elements_of, restylable, round_colours

SQUARE = polygon([(0, 0), (1, 0), (1, 1), (0, 1)])
RED, BLUE = Paint((1.0, 0.0, 0.0)), Paint((0.0, 0.0, 1.0))


def style(
    stacks: list[list[int]], groups: tuple[Group, ...] = (), group: tuple[int, ...] = (-1, -1, -1)
) -> PlanarStyle:
    """Three elements in groups, and paints that are stacks of them."""
    starts = np.cumsum([0, *map(len, stacks)])
    members = np.array([element for stack in stacks for element in stack], np.int32)
    none = np.zeros(3, np.bool_)
    return PlanarStyle(("a", "b", "c"), np.ones((3, 4)), np.array(group), none, groups, starts, members)


def test_the_topmost_element_of_a_paint_is_its_last() -> None:
    assert style([[], [0], [2, 1], [0, 1, 2]]).top.tolist() == [-1, 0, 1, 2]


def test_a_mask_is_not_seen_and_hides_where_it_is_empty() -> None:
    groups = (Group(), Group(0, mask=Mask.OPACITY))
    masked = style([[0, 1, 2], [0, 1], [1, 2], [1]], groups, (-1, 0, 1))  # b is masked by c
    assert masked.top.tolist() == [1, 0, 1, -1]


def test_an_element_is_a_name_a_paint_and_a_group() -> None:
    listed = (
        ("a", RED, -1),
        ("a", RED, -1),
        ("a", BLUE, -1),
        ("", RED, -1),
        ("a", Paint((1.0, 0.0, 0.0)), -1),
        ("a", RED, 0),
    )
    paths = tuple(Path((SQUARE,), paint=paint, element=name, group=group) for name, paint, group in listed)
    first, numbers = elements_of(Drawing(paths, groups=(Group(),)))
    assert numbers.tolist() == [0, 0, 1, 2, 0, 3]
    assert [paths.index(path) for path in first] == [0, 2, 3, 5]


def test_gradients_become_their_means_and_a_note_counts_them() -> None:
    shade = Paint.from_gradient(Gradient(((1, 0, 0), (0, 1, 0)), (Stop(0, (1, 0, 0)), Stop(1, (0, 0, 1)))))
    flat = restylable(Drawing(tuple(Path((SQUARE,), paint=paint) for paint in (shade, RED, shade))))
    assert [path.paint for path in flat.paths] == [Paint((0.5, 0.0, 0.5)), RED, Paint((0.5, 0.0, 0.5))]
    assert [note.count for note in flat.notes] == [2]


def test_groups_are_nested_and_not_too_deep() -> None:
    deep = tuple(Group(place - 1) for place in range(101))
    with pytest.raises(LimitError, match="groups are 101 deep; the limit of what can be restyled is 100"):
        style([], deep).check_groups()
    style([], deep[:100], (0, 1, 99)).check_groups()
    with pytest.raises(SourceError):
        style([], deep[:1], (0, -1, 0)).check_groups()


def test_colours_have_six_decimals() -> None:
    assert round_colours([(1 / 3, 0.1234567, 0.0, 1.0)]).tolist() == [[0.333333, 0.123457, 0.0, 1.0]]
