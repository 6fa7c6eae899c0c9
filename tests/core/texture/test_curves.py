"""Straight curves share texels in pairs (FORMAT.md, D.2)."""

import numpy as np
import pytest

from vexture.base import layout
from vexture.base.errors import FormatError
from vexture.conversion.parameters import Parameters
from vexture.conversion.pipeline import run
from vexture.drawing.drawing import Drawing, Path
from vexture.drawing.paint import Paint
from vexture.texture.curves import LeafCurves, curve_texels, leaf_points, read_leaf_curve, texels_in
from vexture.texture.map_texels import is_straight_leaf, write_leaf
from vexture.texture.planar import decode_map, map_texels
from vexture.texture.texture import Texture

LINE = [[0, 17], [10923, 20], [21845, 22], [32768, 25]]  # thirds: (10922.67, 19.67), (21845.33, 22.33)
RED, BLUE = Paint((1.0, 0.0, 0.0)), Paint((0.0, 0.0, 1.0))


def moved(by: int, axis: int, point: int = 1) -> np.ndarray:
    curve = np.array(LINE, np.int32)
    curve[point, axis] += by
    return curve


def polygon(*corners: tuple[float, float], paint: Paint) -> Path:
    return Path(Drawing.polygon(corners).paths[0].contours, paint=paint)


def are_straight(curves: np.ndarray, count: list[int]) -> list[bool]:
    firsts = np.cumsum(count) - count
    return [is_straight_leaf(curves, first, number) for first, number in zip(firsts.tolist(), count, strict=True)]


def triangle() -> Texture:
    """All leaves are straight, and some have an odd number of pieces."""
    paths = (
        polygon((0.1, 0.1), (0.9, 0.2), (0.3, 0.9), paint=RED),
        polygon((0.9, 0.2), (0.95, 0.8), (0.3, 0.9), paint=BLUE),
    )
    return run(Drawing(paths), Parameters("faces")).texture


@pytest.mark.parametrize(("by", "straight"), [(0, True), (1, True), (-1, True), (2, False), (-2, False)])
@pytest.mark.parametrize("axis", [0, 1])
@pytest.mark.parametrize("point", [1, 2])
def test_a_curve_is_straight_within_a_unit_of_its_thirds(by: int, straight: bool, axis: int, point: int) -> None:
    curves = np.stack([moved(0, 0), moved(by, axis, point), moved(0, 0)])
    assert are_straight(curves, [1, 0, 2]) == [True, False, straight]


def test_curves_of_leaves_read_back() -> None:
    line, bent = np.array(LINE, np.int32), moved(900, 0)
    curves = np.stack([line, bent, line, line, line, line, bent])
    count = np.array([2, 0, 3, 1, 1])
    straight = np.array(are_straight(curves, count.tolist()))
    assert straight.tolist() == [False, False, True, True, False]
    texels, end = np.zeros((texels_in(count, straight).sum(), 4), np.uint32), 0
    assert len(texels) == 2 + 2 + 1 + 1
    for first, number, is_straight in zip((np.cumsum(count) - count).tolist(), count.tolist(), straight, strict=True):
        end += write_leaf(curves, first, number, bool(is_straight), texels[end:])
    assert end == len(texels)
    np.testing.assert_array_equal(texels[[0, 1, 5]], curve_texels(curves[[0, 1, 6]]))
    assert not texels[[3, 4], 2:].any()
    np.testing.assert_array_equal(leaf_points(texels, LeafCurves.of_counts(count, straight)), curves)
    found = np.empty((4, 2))
    for i in range(3):
        read_leaf_curve(texels, 2, (3 << layout.COUNT_SHIFT) + layout.STRAIGHT, i, found)
        np.testing.assert_array_equal(found, line)


def test_a_map_reads_back_with_leaves_of_both_kinds() -> None:
    corner = polygon((0.6, 0.1), (0.9, 0.4), (0.6, 0.4), paint=RED)
    bow = np.array([[(0.1, 0.6), (0.2, 0.9), (0.3, 0.9), (0.4, 0.6)], [(0.4, 0.6), (0.3, 0.6), (0.2, 0.6), (0.1, 0.6)]])
    flat = run(Drawing((corner, Path((bow,), paint=BLUE))), Parameters("faces")).texture.flat
    cells = flat[2, 2] >> np.arange(0, 32, layout.CELL_BITS) & 0xFF
    curves = cells >> layout.COUNT_SHIFT
    assert set((cells & layout.STRAIGHT)[curves > 0]) == {0, 1}
    planar = decode_map(flat, 2)
    assert len(planar.curves) == curves.sum()
    texels = map_texels(planar, 0)
    np.testing.assert_array_equal(texels, flat[: len(texels)])


@pytest.mark.parametrize(
    ("word", "value", "message"),
    [(2, 1, "of one curve has a second one"), (0, 0x9000, "has an end at 36864"), (1, 0, "goes down")],
)
def test_damaged_pairs_are_refused(word: int, value: int, message: str) -> None:
    texture = triangle()
    cells = texture.flat[2, 2] >> np.arange(0, 32, layout.CELL_BITS) & 0xFF
    count = (cells >> layout.COUNT_SHIFT).astype(int)
    assert (cells[count > 0] & layout.STRAIGHT).all()
    odd = int(np.flatnonzero(count % 2)[0])
    last = int(texture.flat[2, 1]) + int(((count[: odd + 1] + 1) >> 1).sum()) - 1
    flat = texture.flat.copy()
    flat[last, word] = value
    with pytest.raises(FormatError, match=message):
        Texture(flat.reshape(texture.texels.shape), texture.roots).check()
