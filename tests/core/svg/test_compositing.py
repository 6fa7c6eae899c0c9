"""Groups of an SVG: shared opacity, blend modes and isolation, where a picture shows them, and nowhere else."""

import warnings
from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from svg_reference import render_file

from vexture import read
from vexture.base.errors import SourceWarning
from vexture.drawing.drawing import Drawing
from vexture.drawing.group import Blend, Group

SIDE = 8
ROOT = f'<svg xmlns="http://www.w3.org/2000/svg" width="{SIDE}" height="{SIDE}" viewBox="0 0 {SIDE} {SIDE}"'
ONE = '<rect width="5" height="5"/>'
TWO = f'{ONE}<rect x="2" width="5" height="5"/>'
BESIDE = '<rect width="2" height="5"/><rect x="2" width="5" height="5"/>'
OUTSIDE = '<rect x="20" width="5" height="5"/><rect x="20" width="5" height="5"/>'
MULTIPLIED = '<rect width="5" height="5" style="mix-blend-mode: multiply"/>'

HALF, MULTIPLY = Group(opacity=0.5), Group(blend=Blend.MULTIPLY)


def drawing_of(body: str, root: str = "", select: str | None = None) -> Drawing:
    return read(f"{ROOT} {root}>{body}</svg>".encode(), select=select)


@pytest.mark.parametrize(
    ("body", "groups", "opacities"),
    [
        (f'<g opacity=".5">{TWO}</g>', [HALF], [1, 1]),
        (f'<g opacity="1">{TWO}</g>', [], [1, 1]),
        (f'<g opacity=".5">{ONE}</g>', [], [0.5]),
        (f'<g opacity=".5">{BESIDE}</g>', [], [0.5, 0.5]),
        (f'<g opacity=".5">{OUTSIDE}</g>{ONE}', [], [1]),
        (f'<g opacity=".5">{OUTSIDE}</g><g opacity=".5">{TWO}</g>', [HALF], [1, 1]),
        (f'<g opacity=".5"><g display="none">{TWO}</g>{ONE}</g>', [], [0.5]),
        (f'<g opacity=".5"><g opacity=".5">{ONE}</g>{ONE}</g>', [HALF], [0.5, 1]),
        (f'<g opacity=".5"><g opacity=".5">{TWO}</g>{ONE}</g>', [HALF, Group(0, 0.5)], [1, 1, 1]),
        ('<rect width="5" height="5" stroke="red" opacity=".5"/>', [HALF], [1, 1]),
        (f'<g style="mix-blend-mode: multiply; opacity: .5">{ONE}</g>', [MULTIPLY], [0.5]),
        (f'<g style="mix-blend-mode: multiply; opacity: .5">{TWO}</g>', [Group(-1, 0.5, Blend.MULTIPLY)], [1, 1]),
        (f'<g style="mix-blend-mode: normal">{TWO}</g>', [], [1, 1]),
        (f'<g style="isolation: isolate">{TWO}</g>', [], [1, 1]),
        (f'<g style="isolation: isolate">{MULTIPLIED}</g>', [], [1]),
        (f'<g style="isolation: isolate">{ONE}{MULTIPLIED}</g>', [Group(), Group(0, 1, Blend.MULTIPLY)], [1, 1]),
        (f'<g opacity=".5">{ONE}{MULTIPLIED}</g>', [HALF, Group(0, 1, Blend.MULTIPLY)], [1, 1]),
        (f'<g style="isolation: isolate"><g opacity=".5">{TWO}</g></g>', [HALF], [1, 1]),
        (f'<g style="isolation: isolate">{TWO}<g style="mix-blend-mode: screen"/></g>', [], [1, 1]),
    ],
)
def test_an_element_is_a_group_where_a_picture_shows_it(body: str, groups: list[Group], opacities: list[float]) -> None:
    drawing = drawing_of(body)
    assert drawing.groups == tuple(groups)
    assert [path.paint.opacity for path in drawing.paths] == opacities


@pytest.mark.parametrize("blend", Blend)
def test_each_blend_mode_of_css_is_known(blend: Blend) -> None:
    name = blend.name.replace("_", "-")
    groups = drawing_of(f'<rect width="5" height="5" style="mix-blend-mode: {name}"/>').groups
    assert groups == (() if blend is Blend.NORMAL else (Group(blend=blend),))


def test_an_unknown_blend_mode_is_invalid_and_normal() -> None:
    with pytest.warns(SourceWarning, match=r"invalid and ignored: mix-blend-mode='melt' of <rect> in line 1$"):
        drawing = drawing_of('<rect width="5" height="5" style="mix-blend-mode: melt"/>')
    assert drawing.groups == ()


def test_a_selected_part_keeps_the_groups_around_it() -> None:
    body = f'<g opacity=".5"><g style="mix-blend-mode: screen"><g id="a">{TWO}</g></g>{ONE}</g>'
    drawing = drawing_of(body, select="#a")
    assert drawing.groups == (Group(opacity=0.5), Group(0, 1, Blend.SCREEN))
    assert [path.group for path in drawing.paths] == [1, 1]


MIXED: dict[Blend, Callable[[Any, Any], Any]] = {
    Blend.NORMAL: lambda below, above: above,
    Blend.MULTIPLY: lambda below, above: below * above,
    Blend.SCREEN: lambda below, above: below + above - below * above,
    Blend.DIFFERENCE: lambda below, above: np.abs(below - above),
    Blend.DARKEN: np.minimum,
}
"""Formulas of Compositing and Blending 1, 10.1."""


def color(picture: np.ndarray) -> np.ndarray:
    return np.divide(picture[..., :3], picture[..., 3:], out=np.zeros((SIDE, SIDE, 3)), where=picture[..., 3:] > 0)


def put(below: np.ndarray, above: np.ndarray, group: Group) -> np.ndarray:
    """Compositing and Blending 1, 9.1.4, of premultiplied pictures."""
    above = above * group.opacity
    both = below[..., 3:] * above[..., 3:]
    mixed = both * MIXED[group.blend](color(below), color(above))
    sides = (1 - above[..., 3:]) * below[..., :3] + (1 - below[..., 3:]) * above[..., :3]
    return np.concatenate([mixed + sides, below[..., 3:] + above[..., 3:] - both], axis=2)


def composited(drawing: Drawing) -> np.ndarray:
    """A drawing of rectangles along pixels, premultiplied, (side, side, 4)."""
    x, y = np.meshgrid(*[(np.arange(SIDE) + 0.5) / SIDE] * 2)
    stack, inside = [np.zeros((SIDE, SIDE, 4))], list[int]()

    def leave(depth: int) -> None:
        while len(inside) > depth:
            above = stack.pop()
            stack[-1] = put(stack[-1], above, drawing.groups[inside.pop()])

    for path in drawing.paths:
        around = drawing.around(path.group)
        leave(sum(one == other for one, other in zip(inside, around, strict=False)))
        for place in around[len(inside) :]:
            inside.append(place)
            stack.append(np.zeros((SIDE, SIDE, 4)))
        (left, bottom), (right, top) = path.box
        covered = (x > left) & (x < right) & (1 - y > bottom) & (1 - y < top)
        stack[-1] = put(stack[-1], covered[..., None] * np.append(path.paint.color, 1.0), Group(-1, path.paint.opacity))
    leave(0)
    return stack[0]


ATTRIBUTES = (
    *[""] * 4,
    'opacity="0.3"',
    'opacity="0.8"',
    'style="isolation: isolate"',
    'transform="translate(1 1)"',
    'display="none"',
    *(f'style="mix-blend-mode: {blend.name.lower()}"' for blend in MIXED),
)
RECTANGLE = '<rect x="{}" y="{}" width="{}" height="{}" fill="{}" fill-opacity="{}" {}/>'
CORNER, LENGTH = st.integers(0, SIDE - 2), st.integers(1, SIDE)
SHAPES = st.tuples(
    *(CORNER, CORNER, LENGTH, LENGTH),
    *(st.sampled_from(("#c08040", "#4080e0", "#60d070")), st.sampled_from((1, 0.6)), st.sampled_from(ATTRIBUTES)),
).map(lambda values: RECTANGLE.format(*values))
TREES = st.recursive(
    SHAPES,
    lambda inner: st.tuples(st.sampled_from(ATTRIBUTES), st.lists(inner, min_size=1, max_size=4)).map(
        lambda parts: f"<g {parts[0]}>{''.join(parts[1])}</g>"
    ),
    max_leaves=12,
)


@pytest.mark.slow
@settings(max_examples=150, deadline=None)
@given(st.lists(TREES, min_size=2, max_size=4), st.sampled_from(("", 'opacity="0.6"')))
def test_random_groups_look_as_resvg_draws_them(trees: list[str], root: str) -> None:
    body = "".join(trees)
    with warnings.catch_warnings(action="ignore", category=SourceWarning):  # of pictures of nothing
        drawing = drawing_of(body, root)
    theirs = render_file(f"{ROOT} {root}>{body}</svg>")
    np.testing.assert_allclose(composited(drawing), theirs, atol=0.025)  # theirs has 8 bits in each layer


OPACITY = st.sampled_from((1, 0.2, 0.7))


@given(st.lists(st.tuples(OPACITY, OPACITY, OPACITY, st.booleans()), min_size=1, max_size=5), OPACITY)
def test_layers_have_the_product_of_all_opacities(parts: list[tuple[float, float, float, bool]], root: float) -> None:
    body = "".join(
        f'<g opacity="{outer}" style="mix-blend-mode: {"screen" if blended else "normal"}"><g opacity="{inner}">'
        f'<rect width="5" height="5" fill-opacity="{own}"/>{ONE}</g></g>'
        for outer, inner, own, blended in parts
    )
    layers = drawing_of(body, f'opacity="{root}"').layers()
    flat = [path.paint.opacity for layer in layers for path in layer.paths]
    np.testing.assert_allclose(flat, [root * a * b * c for a, b, own, _ in parts for c in (own, 1.0)], rtol=1e-12)
