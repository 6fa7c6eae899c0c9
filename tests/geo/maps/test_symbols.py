"""Symbols at points: the paths of a drawing about each point, placed together, are those of each placed alone."""

import numpy as np
import pytest

from vexture.base.errors import SourceError
from vexture.conversion.reading import read_drawing
from vexture.drawing.drawing import Path
from vexture.drawing.paint import Paint
from vexture_geo.maps.paths import MapFit
from vexture_geo.maps.symbols import Symbols

SYMBOL = read_drawing(
    b'<svg viewBox="0 0 4 4"><path d="M0 0h4v4h-4zM1 1v2h2v-2z"/><circle cx="2" cy="2" r="1" fill="red"/></svg>'
)
POINTS = np.array([(10.0, 20.0), (30.0, 40.0), (30.0, 5.0)])
SIZES = np.array([1.0, 2.0, 0.3])


def test_symbols_that_are_placed_together_are_those_placed_alone():
    symbols = Symbols(SYMBOL, POINTS, SIZES, ["a", "b", "c"], [None, Paint((0.0, 1.0, 0.0)), None])
    fit = MapFit((0.0, 0.0, 50.0, 50.0))
    placed = [*symbols.paths(fit)]
    assert [path.element for path in placed] == [name for name in "abc" for _ in SYMBOL.paths]
    expected = [(path, point, size) for point, size in zip(POINTS, SIZES, strict=True) for path in SYMBOL.paths]
    starts = []
    for path, (symbol, point, size) in zip(placed, expected, strict=True):
        Path(path.contours)  # which checks that they are closed
        for contour, start in zip(path.contours, symbol.contours, strict=True):
            np.testing.assert_array_equal(contour, fit.inward((start - 0.5) * size + point))
            starts.append((start[:, 0] - 0.5) * size + point)
    every = np.concatenate(starts)
    np.testing.assert_array_equal(symbols.corners, [every.min(axis=0), every.max(axis=0)])
    assert placed[0].contours[0].base is placed[-len(SYMBOL.paths)].contours[0].base  # not one operation for each
    assert placed[len(SYMBOL.paths)].paint.color == (0.0, 1.0, 0.0)
    assert placed[0].paint.color == SYMBOL.paths[0].paint.color


def test_a_point_without_a_place_is_refused():
    with pytest.raises(SourceError, match="a point has no place on the map"):
        Symbols(SYMBOL, POINTS * np.inf, SIZES, ["a", "b", "c"], [None] * 3)
