import math

import numpy as np
import pytest
from hand import (
    EMPTY,
    FULL,
    LOOP,
    NOTCH,
    QUARTERS,
    ROOF,
    S_CURVE,
    SWIRL,
    TREE,
    Corner,
    Curve,
    Floats,
    speckles,
    texture_of,
    truth,
    view_of,
)

from vexture.base.errors import ParameterError
from vexture.conversion.images import coverage
from vexture.renderers.view import fit
from vexture.thesis.cpu import render_thesis_cpu
from vexture.thesis.texture import ThesisTexture

SHIFT = 0.00123  # so that no point falls on the edge of a cell


@pytest.mark.parametrize("size", [61, pytest.param(250, marks=pytest.mark.slow)])
def test_the_tree_of_everything_is_drawn_as_counted(size: int) -> None:
    texture, view = texture_of(TREE), view_of((SHIFT, SHIFT), 0.99, size)
    image = render_thesis_cpu(texture, (size, size), view)
    assert speckles(texture, image, view) == 0
    assert np.abs(image - truth(texture, (size, size), view)).mean() < 1e-4


def test_a_rotated_view_looks_where_it_says() -> None:
    cosine, sine = 0.013 * math.cos(0.5), 0.013 * math.sin(0.5)
    view = np.array([[cosine, sine, 0.02], [sine, -cosine, 0.5], [0, 0, 1.0]])
    texture = texture_of(TREE)
    assert speckles(texture, render_thesis_cpu(texture, (70, 50), view[:2]), view) == 0


@pytest.mark.parametrize("outline", [*QUARTERS, LOOP, SWIRL, S_CURVE, ROOF, NOTCH])
def test_a_reversed_outline_is_the_complement(outline: Curve | Corner) -> None:
    if isinstance(outline, Corner):
        back: Curve | Corner = Corner(outline.edge3, outline.corner, outline.edge0)
    else:
        back = Curve(outline.edge3, outline.p2, outline.p1, outline.edge0)
    view = view_of((SHIFT, SHIFT), 0.49, 40)
    there, again = (render_thesis_cpu(texture_of([EMPTY, EMPTY, o, EMPTY]), (40, 40), view) for o in (outline, back))
    difference = np.abs(there + again - 1)
    assert difference.max() <= 1 / 16
    assert difference.mean() < 1e-3


@pytest.mark.parametrize("clockwise", [True, False])
def test_an_outline_that_ends_where_it_starts_holds_its_inside_or_all_else(clockwise: bool) -> None:
    right, left = (1.2, -0.4), (-0.2, -0.4)
    loop = Curve(0.1, right, left, 0.1) if clockwise else Curve(0.1, left, right, 0.1)  # down from the top edge
    image = render_thesis_cpu(texture_of([EMPTY, EMPTY, loop, EMPTY]), (9, 9), view_of((0, 0), 0.5, 9))
    assert image[4, 4] == (1.0 if clockwise else 0.0)
    np.testing.assert_array_equal(image[[0, 0, 8, 8], [0, 8, 0, 8]], 0.0 if clockwise else 1.0)


def test_a_quad_smaller_than_a_pixel_is_its_stored_coverage() -> None:
    texture = texture_of([EMPTY, [FULL, EMPTY, FULL, FULL], EMPTY, EMPTY])
    texture.quads[1, :, 2] = 10_000
    largest = view_of((0.5, 0.5), 0.5, 1)
    assert render_thesis_cpu(texture, (1, 1), largest)[0, 0] == 0.75, "as large as a pixel: its cells count"
    grown = largest * (1.0001, 1.0001, 1.0)
    assert render_thesis_cpu(texture, (1, 1), grown)[0, 0] == pytest.approx(10_000 / 65535)
    everything = fit((1, 1)) * (1.0001, 1.0001, 1.0)
    assert render_thesis_cpu(texture, (1, 1), everything)[0, 0] == pytest.approx(texture.quads[0, 0, 2] / 65535)


def test_the_edge_of_the_square_is_smoothed() -> None:
    full = texture_of([FULL] * 4)
    image = render_thesis_cpu(full, (6, 4), [[0.25, 0, -0.125], [0, -0.25, 1.0625]])
    np.testing.assert_allclose(image[1:-1], [[0.5, 1, 1, 1, 0.5, 0]] * 2)
    np.testing.assert_allclose(image[:, 2], [0.75, 1, 1, 1])


def test_beyond_the_horizon_is_nothing() -> None:
    horizon = [[0.05, 0.0625, -0.25], [0.0, 0.0625, -0.23], [0.0, 0.125, -0.5]]  # at the middle of the image
    image = render_thesis_cpu(texture_of([FULL] * 4), (8, 8), horizon)
    assert not image[:4].any()
    assert image[-1, :3].all()


def test_cells_of_one_curve_join_without_a_line() -> None:
    whole = texture_of([EMPTY, EMPTY, Curve(0.75, (0.0, 0.55), (0.45, 1.0), 0.25), EMPTY])
    curve = np.array([(0, 0), (0.0, 0.55), (0.45, 1.0), (1, 1)], float)
    texture = texture_of([EMPTY, EMPTY, divided(curve, 3), EMPTY])
    view = view_of((SHIFT, SHIFT), 0.49, 200)
    difference = np.abs(render_thesis_cpu(whole, (200, 200), view) - render_thesis_cpu(texture, (200, 200), view))
    assert difference.max() <= 2 / 16  # 16 bits move a point by 1/300 of a pixel here
    assert difference.mean() < 1e-4


def divided(curve: Floats, levels: int) -> object:
    """Divide a curve that rises in x and y, in its cell, into cells on deeper levels."""
    if levels == 0:
        return as_leaf(curve)
    cells = []
    for low in ((0, 0.5), (0.5, 0.5), (0, 0), (0.5, 0)):
        inside = [part_in(curve, axis, low[axis], low[axis] + 0.5) for axis in (0, 1)]
        t0, t1 = max(i[0] for i in inside), min(i[1] for i in inside)
        if t1 - t0 > 1e-6:
            cells.append(divided((blossom(curve, t0, t1) - low) * 2, levels - 1))
        else:  # the filled side is below
            middle = blossom(curve, *part_in(curve, 0, low[0], low[0] + 0.5)).mean(0)
            cells.append(FULL if middle[1] > low[1] + 0.25 else EMPTY)
    return cells


def part_in(curve: Floats, axis: int, low: float, high: float) -> tuple[float, float]:
    """Parameters between which a rising coordinate lies between two values."""
    t = np.linspace(0, 1, 100_001)
    values = blossom_points(curve, t)[:, axis]
    return float(np.interp(low, values, t)), float(np.interp(high, values, t))


def blossom_points(curve: Floats, t: Floats) -> Floats:
    s = 1 - t
    weights = np.array([s**3, 3 * s * s * t, 3 * s * t * t, t**3])
    return weights.T @ curve


def blossom(curve: Floats, t0: float, t1: float) -> Floats:
    """The part of a curve between two parameters."""

    def polar(*ts: float) -> Floats:
        points = curve
        for t in ts:
            points = points[:-1] * (1 - t) + points[1:] * t
        return points[0]

    return np.array([polar(t0, t0, t0), polar(t0, t0, t1), polar(t0, t1, t1), polar(t1, t1, t1)])


def as_leaf(curve: Floats) -> Curve:
    def edge(point: Floats) -> float:
        x, y = point
        sides = {x / 4: 1 - y, 0.25 + (1 - y) / 4: 1 - x, 0.5 + (1 - x) / 4: y, 0.75 + y / 4: x}
        return float(min(sides, key=lambda side: abs(sides[side])))

    return Curve(edge(curve[0]), tuple(curve[1]), tuple(curve[2]), edge(curve[3]))


def test_eight_bits_are_read_by_the_same_rule() -> None:
    texture = texture_of(TREE, bits=8)
    view = view_of((SHIFT, SHIFT), 0.99, 100)
    assert speckles(texture, render_thesis_cpu(texture, (100, 100), view), view) == 0


def test_a_texture_without_end_is_drawn_all_the_same() -> None:
    cycle = ThesisTexture(np.full((1, 4, 3), (255, 0, 0), np.uint8), np.zeros((2, 2, 3), np.uint8))
    assert not render_thesis_cpu(cycle, (4, 4)).any()


@pytest.mark.parametrize(("renderer", "message"), [("exact", "drawing"), ("magic", "'exact', 'cpu', 'gpu'")])
def test_a_renderer_that_cannot_draw_it_says_so(renderer: str, message: str) -> None:
    with pytest.raises(ParameterError, match=message):
        coverage(texture_of([FULL] * 4), (4, 4), renderer=renderer)
