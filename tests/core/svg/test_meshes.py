"""Gradient meshes: their colours by independent formulas for patches, and what is said of those that are not drawn."""

import warnings
from collections.abc import Callable, Sequence
from itertools import pairwise
from pathlib import Path

import numpy as np
import pytest
from numpy.typing import NDArray
from svg_reference import render_file

import vexture
from vexture.base.errors import SourceWarning
from vexture.drawing.drawing import Drawing
from vexture.drawing.picture import Picture
from vexture.renderers.exact import render_exact_colours
from vexture.svg.read import read_svg

Values = NDArray[np.float64]
Point = tuple[float, float]

FIXTURES = Path(__file__).parent / "fixtures" / "meshes"
LEVEL = 1 / 255
RED, BLUE, LIME, BLACK, WHITE = (1, 0, 0), (0, 0, 1), (0, 1, 0), (0, 0, 0), (1, 1, 1)


def drawing_of(body: str) -> Drawing:
    with warnings.catch_warnings(action="ignore", category=SourceWarning):
        return vexture.read(f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 100 100">{body}</svg>'.encode())


def stop(path: str, color: tuple[float, ...] | None = None, opacity: float = 1.0) -> str:
    said = "" if color is None else f' stop-color="rgb({" ".join(f"{100 * part}%" for part in color)})"'
    return f'<stop path="{path}" stop-opacity="{opacity}"{said}/>'


def mesh(rows: list[list[str]], attributes: str = 'gradientUnits="userSpaceOnUse"') -> str:
    """The mesh #m of rows of patches, each the text of its stops."""
    body = "".join(f"<meshrow>{''.join(f'<meshpatch>{patch}</meshpatch>' for patch in row)}</meshrow>" for row in rows)
    return f'<meshgradient id="m" {attributes}>{body}</meshgradient>'


def square(*colors: tuple[float, float, float], opacities: tuple[float, ...] = (1, 1, 1, 1), side: float = 100) -> str:
    """The only patch, with straight sides and the colours of its corners, clockwise from the upper left one."""
    paths = f"l {side} 0", f"L {side} {side}", f"l -{side} 0", "l 0 0"
    return "".join(map(stop, paths, colors, opacities))


WHOLE = '<path fill="url(#m)" d="M0 0H100V100H0z"/>'


def picture_of(drawing: Drawing) -> Picture:
    (path,) = drawing.paths
    assert path.paint.picture is not None
    return path.paint.picture


def far(picture: Picture, points: Values, expected: Values) -> float:
    """Largest difference between colours at points of the page, y down, and premultiplied ones."""
    found = np.array([picture.color_at(x / 100, 1 - y / 100) for x, y in points.reshape(-1, 2).tolist()])
    return float(np.abs(found - expected.reshape(-1, 4)).max()) / LEVEL


def bezier(points: list[Point], t: Values) -> Values:
    """Points of a cubic by de Casteljau's algorithm."""
    level = [np.array(point) + 0.0 * t[..., None] for point in points]
    while len(level) > 1:
        level = [(1 - t[..., None]) * one + t[..., None] * other for one, other in pairwise(level)]
    return level[0]


def mixed(corners: Sequence[tuple[float, ...]], u: Values, v: Values) -> Values:
    """Bilinear mixture of the values of corners, clockwise from the upper left one."""
    weights = (1 - u) * (1 - v), u * (1 - v), u * v, (1 - u) * v
    return np.asarray(
        sum(weight[..., None] * np.array(corner) for weight, corner in zip(weights, corners, strict=True))
    )


def premultiplied(colors: Values) -> Values:
    return np.concatenate([colors[..., :3] * colors[..., 3:], colors[..., 3:]], axis=-1)


GRID = np.meshgrid(np.linspace(0.02, 0.98, 17), np.linspace(0.02, 0.98, 17))


def test_a_square_is_bilinear_in_every_pixel() -> None:
    drawing = drawing_of(mesh([[square(RED, BLUE, LIME, BLACK)]]) + WHOLE)
    image = render_exact_colours(drawing, 20)
    u, v = np.meshgrid((np.arange(20) + 0.5) / 20, (np.arange(20) + 0.5) / 20)
    expected = mixed([(*color, 1.0) for color in (RED, BLUE, LIME, BLACK)], u, v)
    assert np.abs(image - expected).max() < 1.2 * LEVEL
    assert picture_of(drawing).pixels.shape == (128, 128, 4)
    assert [str(note) for note in drawing.notes] == ["gradient mesh sampled at 128 x 128 points"]


def test_opacities_are_not_premultiplied_as_in_other_gradients() -> None:
    opacities = (1.0, 0.0, 0.5, 1.0)
    drawing = drawing_of(mesh([[square(RED, BLUE, LIME, WHITE, opacities=opacities)]]) + WHOLE)
    corners = [(*color, alpha) for color, alpha in zip((RED, BLUE, LIME, WHITE), opacities, strict=True)]
    u, v = GRID
    assert far(picture_of(drawing), 100 * np.stack([u, v], axis=-1), premultiplied(mixed(corners, u, v))) < 1.5


def test_curved_sides_make_a_coons_patch() -> None:
    top: list[Point] = [(10, 20), (30, 0), (60, 30), (90, 10)]
    right: list[Point] = [(90, 10), (100, 40), (70, 60), (80, 90)]
    bottom: list[Point] = [(80, 90), (60, 70), (40, 100), (20, 80)]
    left: list[Point] = [(20, 80), (0, 60), (40, 40), (10, 20)]
    colors = RED, BLUE, LIME, WHITE
    paths = ["C" + " ".join(f"{x},{y}" for x, y in side[1:]) for side in (top, right, bottom, left)]
    paths[3] = paths[3].rsplit(" ", 1)[0]  # the last point is known
    drawing = drawing_of(
        mesh([["".join(map(stop, paths, colors))]], 'gradientUnits="userSpaceOnUse" x="10" y="20"') + WHOLE
    )
    u, v = (0.1 + 0.8 * places for places in GRID)  # the edge is soft
    ruled = (1 - v)[..., None] * bezier(top, u) + v[..., None] * bezier(bottom[::-1], u)
    ruled += (1 - u)[..., None] * bezier(left[::-1], v) + u[..., None] * bezier(right, v)
    points = ruled - mixed([top[0], top[3], right[3], bottom[3]], u, v)
    assert far(picture_of(drawing), points, mixed([(*color, 1.0) for color in colors], u, v)) < 2.5
    image = render_exact_colours(drawing, 100)
    assert max(image[2, 2, 3], image[50, 98, 3]) < 1e-6  # beyond the mesh


SPECIFIED = [
    [
        stop("c 25,-25 75,25 100,0", (0.5, 0.8, 0.9))
        + stop("c 25,25 -25,75 0,100", (0.5, 0, 0.5))
        + stop("c -25,25 -75,-25 -100,0", RED)
        + stop("c -25,-25 25,-75", (0.5, 0, 0.5)),
        stop("c 25,-25 75,25 100,0")
        + stop("c 25,25 -25,75 0,100", (0.5, 0.8, 0.9))
        + stop("c -25,25 -75,-25", (0.5, 0, 0.5)),
    ],
    [
        stop("c 25,25 -25,75 0,100") + stop("c -25,25 -75,-25 -100,0", (0.5, 0, 0.5)) + stop("c -25,-25 25,-75", LIME),
        stop("c 25,25 -25,75 0,100") + stop("c -25,25 -75,-25", BLUE),
    ],
]
"""The mesh of the specification's example, with other colours of the lower corners."""


def test_a_mesh_that_is_a_linear_gradient_looks_like_one() -> None:
    plain = """<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 100 100" width="200" height="200">
    <linearGradient id="g" gradientUnits="userSpaceOnUse" x1="-10" x2="110">
    <stop stop-color="#e02020"/><stop offset="1" stop-color="#2040e0"/></linearGradient>
    <circle cx="50" cy="50" r="45" fill="url(#g)"/></svg>"""
    mean = render_file(plain).reshape(25, 8, 25, 8, 4).mean(axis=(1, 3))
    with warnings.catch_warnings(action="ignore", category=SourceWarning):
        gap = np.abs(render_exact_colours(read_svg(FIXTURES / "ramp.svg"), 25) - mean).max(axis=2)
    assert gap.mean() < 0.6 * LEVEL
    assert gap.max() < 2.5 * LEVEL  # resvg's edge is that of pixels


def test_a_mesh_of_inkscape() -> None:
    """Styles of stops, groups of numbers, and a second element with a transform."""
    with warnings.catch_warnings(action="ignore", category=SourceWarning):
        picture = picture_of(read_svg(FIXTURES / "inkscape.svg"))
    x, y = np.meshgrid(np.linspace(21, 79, 21), np.linspace(21, 79, 21))
    u, v = ((places - 5) / 0.9 - 10 for places in (x, y))
    navy = (0, 0, 128 / 255, 1)
    left = mixed([(*RED, 1), navy, (*RED, 1), (*LIME, 1)], u / 40, v / 79.99)
    right = mixed([navy, (*RED, 1), navy, (*RED, 1)], u / 40 - 1, v / 79.99)
    assert far(picture, np.stack([x, y], axis=-1), np.where(u[..., None] < 40, left, right)) < 3.0


def test_patches_share_sides_and_corners() -> None:
    body = mesh(SPECIFIED, 'gradientUnits="userSpaceOnUse" x="25" y="25"')
    drawing = drawing_of('<g transform="scale(0.4)">' + body + '<path fill="url(#m)" d="M0 0H250V250H0z"/></g>')
    corners = {
        (0, 0): (0.5, 0.8, 0.9), (1, 0): (0.5, 0, 0.5), (2, 0): (0.5, 0.8, 0.9), (0, 1): (0.5, 0, 0.5), (1, 1): RED,
        (2, 1): (0.5, 0, 0.5), (0, 2): LIME, (1, 2): (0.5, 0, 0.5), (2, 2): BLUE,
    }  # fmt: skip
    u, v = (0.1 + 0.8 * places for places in GRID)
    for row in range(2):
        for column in range(2):
            colors = [(*corners[column + i, row + j], 1.0) for i, j in ((0, 0), (1, 0), (1, 1), (0, 1))]
            points = bezier([(0, 0), (25, -25), (75, 25), (100, 0)], u) + bezier(
                [(0, 0), (25, 25), (-25, 75), (0, 100)], v
            )
            place = 0.4 * (points + np.array([25 + 100 * column, 25 + 100 * row]))
            assert far(picture_of(drawing), place, mixed(colors, u, v)) < 3.0
    across, down = picture_of(drawing).pixels.shape[:2]
    assert max(across, down) == 128


def test_bicubic_colours_are_smooth_and_do_not_overshoot() -> None:
    """Columns of black, white and black: the slope in the middle is 0, those at the sides are of parabolas."""
    edges = (BLACK, WHITE, BLACK)
    first = (
        stop("l 50 0", edges[0]) + stop("l 0 100", edges[1]) + stop("l -50 0", edges[1]) + stop("l 0 -100", edges[0])
    )
    second = stop("l 50 0") + stop("l 0 100", edges[2]) + stop("l -50 0", edges[2])
    units = 'gradientUnits="userSpaceOnUse" type="bicubic"'
    picture = picture_of(drawing_of(mesh([[first, second]], units) + WHOLE))
    x = np.linspace(1.0, 49.0, 25)
    t = x / 50
    grey = 2 * t - t * t  # the cubic from 0 with the slope 2 to 1 with the slope 0
    expected = np.stack([grey, grey, grey, np.ones_like(grey)], axis=1)
    for places in (x, 100 - x):
        assert far(picture, np.stack([places, np.full_like(x, 50.0)], axis=1), expected) < 1.5
    level = [mesh([[square(BLACK, WHITE, WHITE, BLACK)]], attributes) for attributes in (units, units.split()[0])]
    one, other = (picture_of(drawing_of(text + WHOLE)) for text in level)
    assert np.abs(one.pixels.astype(int) - other.pixels).max() <= 1  # a straight ramp stays one


def test_linear_light() -> None:
    units = 'gradientUnits="userSpaceOnUse" color-interpolation="linearRGB"'
    picture = picture_of(drawing_of(mesh([[square(BLACK, WHITE, WHITE, BLACK)]], units) + WHOLE))
    x = np.linspace(5.0, 95.0, 31)
    grey = 1.055 * (x / 100) ** (1 / 2.4) - 0.055
    expected = np.stack([grey, grey, grey, np.ones_like(grey)], axis=1)
    assert far(picture, np.stack([x, x], axis=1), expected) < 2.0


def place_in_box(x: Values, y: Values) -> tuple[Values, Values]:
    """Places in the mesh of places in the page: the shape is 50 wide and 20 high."""
    return (x - 20) / 50, (y - 40) / 20


def place_turned(x: Values, y: Values) -> tuple[Values, Values]:
    """Places in the mesh of places in the page, where the mesh is turned to the left about (50, 50)."""
    return y / 100, (100 - x) / 100


@pytest.mark.parametrize(
    ("attributes", "shape", "place"),
    [
        ("", "M20 40H70V60H20z", place_in_box),
        ('gradientUnits="userSpaceOnUse" gradientTransform="rotate(90 50 50)"', "M20 40H70V60H20z", place_turned),
    ],
)
def test_units_and_transforms(
    attributes: str, shape: str, place: Callable[[Values, Values], tuple[Values, Values]]
) -> None:
    side = 1 if not attributes else 100
    text = mesh([[square(RED, BLUE, LIME, BLACK, side=side)]], attributes)
    picture = picture_of(drawing_of(f'{text}<path fill="url(#m)" d="{shape}"/>'))
    x, y = np.meshgrid(np.linspace(21.0, 69.0, 9), np.linspace(41.0, 59.0, 7))
    expected = mixed([(*color, 1.0) for color in (RED, BLUE, LIME, BLACK)], *place(x, y))
    assert far(picture, np.stack([x, y], axis=-1), expected) < 2.0


def test_a_mesh_may_take_its_patches_from_another_one() -> None:
    other = '<meshgradient id="n" href="#m" gradientTransform="scale(0.5)"/>'
    drawing = drawing_of(mesh([[square(RED, RED, RED, RED)]]) + other + WHOLE.replace("#m", "#n"))
    image = render_exact_colours(drawing, 10)
    assert image[2, 2] == pytest.approx((1, 0, 0, 1), abs=1e-3)
    assert image[7, 7, 3] == 0.0
    assert image[..., 3].sum() == pytest.approx(25, abs=0.2)


@pytest.mark.parametrize(
    "patch",
    [
        "",
        stop("l 9 0", RED) + stop("l 0 9", RED) + stop("l -9 0", RED),
        square(RED, RED, RED, RED).replace("l 100 0", "m 1 1"),
        square(RED, RED, RED, RED).replace("l 100 0", "c 1 1 2"),
    ],
)
def test_a_mesh_that_cannot_be_read_is_named(patch: str) -> None:
    drawing = drawing_of(mesh([[patch]]) + WHOLE.replace("#m)", "#m) lime"))
    assert [str(note) for note in drawing.notes] == ["gradient mesh"]
    assert drawing.paths[0].paint.color == LIME


def test_too_many_patches_are_named() -> None:
    drawing = drawing_of(mesh([[square(RED, RED, RED, RED)] * 4097]) + WHOLE)
    assert [str(note) for note in drawing.notes][:1] == ["gradient mesh"]


def test_the_edge_of_a_mesh_in_a_larger_shape() -> None:
    drawing = drawing_of(mesh([[square(RED, RED, RED, RED, side=50)]]) + WHOLE)
    image = render_exact_colours(drawing, 10)[..., 3]
    assert (image[1:4, 1:4] > 0.999).all()
    assert (image[6:] == 0.0).all()
    assert image.sum() == pytest.approx(25, abs=0.2)
