"""Views and textures for the tests of the packed renderers."""

import math
from collections.abc import Iterator
from typing import Final

import numpy as np
from numpy.typing import NDArray

from vexture.drawing.drawing import Drawing
from vexture.renderers.view import fit, window
from vexture.texture.encode import encode
from vexture.texture.root import Root
from vexture.texture.texture import Texture
from vexture.tree.build import build_tree

View = tuple[tuple[int, int], NDArray[np.float64]]

TILTED = np.array([[0.02, 0.0, -0.5], [0.001, -0.02, 1.1], [0.0, 0.012, 0.1]])
"""A plane to its horizon, for about 97 x 64 pixels."""


def texture_of(drawing: Drawing, **options: float) -> Texture:
    return encode([build_tree(drawing, **options)], [Root(drawing.name)], name=drawing.name)


def turned_view(pixels: float, degrees: float, narrow: float = 1.0) -> View:
    """The turned unit square at so many pixels to its side, `narrow` times fewer from top to bottom."""
    c, s = math.cos(math.radians(degrees)), math.sin(math.radians(degrees))
    ahead = np.array([[pixels * c, -pixels * s, 0.0], [pixels * s / narrow, pixels * c / narrow, 0.0], [0.0, 0.0, 1.0]])
    corners = (ahead @ np.array([[0, 1, 0, 1], [0, 0, 1, 1], [1, 1, 1, 1]]))[:2]
    size = np.ceil(np.ptp(corners, axis=1)).astype(int) + 3
    ahead[:2, 2] = 1.37 - corners.min(axis=1)
    return (int(size[0]), int(size[1])), np.linalg.inv(ahead)


def nudged_view(view: View) -> View:
    """The view, turned by so little that nothing moves, but that the shader for any view must draw it."""
    size, matrix = view
    turn = np.array([[1.0, 1e-9, 0.0], [-1e-9, 1.0, 0.0], [0.0, 0.0, 1.0]])
    return size, matrix @ turn


ENTRIES: Final = {"flat": lambda view: view, "any": nudged_view}
"""Ways to draw an upright view: by `vextureFlatCoverage`, and by `vextureCoverage`."""


def zoomed_view(drawing: Drawing, width: float, pixels: int) -> View:
    """A window around a point of the drawing's outline."""
    cubic = drawing.paths[0].contours[0][0]
    x, y = np.array([0.25, 0.45, 0.24, 0.06]) @ cubic  # about t = 0.4
    return (pixels, pixels), window(x - width / 2, y - width / 2, width, width).matrix((pixels, pixels))


def views(drawing: Drawing) -> Iterator[tuple[str, View]]:
    """A drawing from far and near, upright, turned and tilted."""
    yield "64 pixels", ((64, 64), fit((64, 64)))
    yield "250 pixels", ((250, 250), fit((250, 250)))
    yield "10 x", zoomed_view(drawing, 0.1, 100)
    yield "turned by 30 degrees", turned_view(150, 30)
    yield "45 degrees, 8:1", turned_view(150, 45, 8)
    yield "a tilted plane", ((97, 64), TILTED)
