"""The cubics of a drawing: copies are found, and contours that begin alike are none."""

import numpy as np

from vexture.bezier.convert import line_cubics
from vexture.drawing.drawing import Drawing, FillRule, Path
from vexture.tree.cubics import gather, leave_out_copies, outlines_of


def _ring(*corners: tuple[float, float]) -> np.ndarray:
    start = np.array(corners)
    return line_cubics(start, np.roll(start, -1, axis=0))


def test_contours_that_begin_alike_are_no_copies() -> None:
    one = _ring((0.1, 0.1), (0.9, 0.1), (0.5, 0.9))
    other = _ring((0.1, 0.1), (0.9, 0.1), (0.5, 0.8))
    cubics, _, _ = gather(Drawing((Path((one, other, one.copy()), FillRule.EVENODD),)))
    assert np.array_equal(cubics, other)
    assert len(gather(Drawing((Path((one,)), Path((other,)), Path((one.copy(),)))))[0]) == 6


def test_copies_change_nothing_or_are_left_out() -> None:
    one, other = _ring((0.1, 0.1), (0.9, 0.1), (0.5, 0.9)), _ring((0.2, 0.1), (0.9, 0.2), (0.5, 0.8))

    def left(rule: FillRule, *contours: np.ndarray) -> list[int]:
        cubics, _, _ = gather(Drawing((Path(tuple(contour.copy() for contour in contours), rule),)))
        starts = {one[0, 0, 0]: 1, other[0, 0, 0]: 2}
        return [starts[x] for x in cubics[::3, 0, 0].tolist()]

    assert left(FillRule.NONZERO, one, one, other, other) == [1, 2]
    assert left(FillRule.NONZERO, one, one, other) == [1, 1, 2]
    assert left(FillRule.NONZERO, *[one] * 6, *[other] * 4) == [1, 1, 1, 2, 2]
    assert left(FillRule.EVENODD, one, one, other) == [2]
    assert left(FillRule.EVENODD, one, other, one, one) == [1, 2]
    assert left(FillRule.EVENODD, one, one) == []


def test_only_a_path_of_the_same_rule_and_order_repeats_another() -> None:
    one, other = _ring((0.1, 0.1), (0.9, 0.1), (0.5, 0.9)), _ring((0.2, 0.1), (0.9, 0.2), (0.5, 0.8))
    paths = [
        Path((one, other)),
        Path((one.copy(),)),
        Path((one.copy(), other.copy()), FillRule.EVENODD),
        Path((other.copy(), one.copy())),
        Path((one.copy(), other.copy())),
        Path((one.copy(),)),
    ]
    _, owner, rules = gather(Drawing(tuple(paths)))
    assert np.bincount(owner).tolist() == [6, 3, 6, 6]
    assert rules.tolist() == [0, 0, 1, 0, 0, 0]


def test_copies_are_found_among_many_contours_that_begin_alike() -> None:
    fans = [_ring((0.1, 0.1), (0.9, 0.1), (0.1 + 0.01 * k, 0.9)) for k in range(60)]
    cubics, _, _ = gather(Drawing((Path((*fans, *(fan.copy() for fan in fans)), FillRule.EVENODD),)))
    assert len(cubics) == 0


def test_contours_without_copies_are_not_copied() -> None:
    angles = np.linspace(0.0, 2.0 * np.pi, 20_000, endpoint=False)
    circle = np.stack([np.cos(angles), np.sin(angles)], axis=1)
    rings = tuple(_ring(*(0.5 + radius * circle)) for radius in (0.1, 0.2, 0.3, 0.4))
    outlines = outlines_of(Drawing((Path(rings, FillRule.EVENODD),)))
    cubics, owner = leave_out_copies(*outlines)
    assert np.shares_memory(cubics, outlines.cubics)
    assert owner.shape == (80_000,)
    assert not owner.any()
