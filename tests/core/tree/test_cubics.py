"""The cubics of a drawing: copies are found, and contours that begin alike are none."""

import tracemalloc

import numpy as np

from vexture.bezier.convert import line_cubics
from vexture.drawing.drawing import Drawing, FillRule, Path
from vexture.tree.cubics import gather


def _ring(*corners: tuple[float, float]) -> np.ndarray:
    start = np.array(corners)
    return line_cubics(start, np.roll(start, -1, axis=0))


def test_contours_that_begin_alike_are_no_copies() -> None:
    one = _ring((0.1, 0.1), (0.9, 0.1), (0.5, 0.9))
    other = _ring((0.1, 0.1), (0.9, 0.1), (0.5, 0.8))
    cubics, _, _ = gather(Drawing((Path((one, other, one.copy()), FillRule.EVENODD),)))
    assert np.array_equal(cubics, other)
    assert len(gather(Drawing((Path((one,)), Path((other,)), Path((one.copy(),)))))[0]) == 6


def test_contours_without_copies_are_not_copied_to_compare_them() -> None:
    angles = np.linspace(0.0, 2.0 * np.pi, 20_000, endpoint=False)
    circle = np.stack([np.cos(angles), np.sin(angles)], axis=1)
    rings = tuple(_ring(*(0.5 + radius * circle)) for radius in (0.1, 0.2, 0.3, 0.4))
    drawing = Drawing((Path(rings, FillRule.EVENODD),))
    tracemalloc.start()
    cubics, owner, _ = gather(drawing)
    peak = tracemalloc.get_traced_memory()[1]
    tracemalloc.stop()
    assert peak < 1.5 * (cubics.nbytes + owner.nbytes)
