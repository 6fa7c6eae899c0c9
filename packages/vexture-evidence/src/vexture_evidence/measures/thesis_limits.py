"""The limits that chapter 6 of the thesis names, measured; those that vexture removed are restored here."""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Final, NamedTuple

import numpy as np
from numpy.typing import NDArray

from vexture.base.errors import LimitError
from vexture.base.layout import MOST_ROWS, ROW_BITS
from vexture.bezier.points import points_along
from vexture.conversion.images import coverage
from vexture.drawing.drawing import Drawing, FillRule, Path
from vexture.renderers.exact import render_exact
from vexture.renderers.view import window
from vexture.texture.texture import Texture
from vexture.thesis.layout import CONTROL_MAX, CONTROL_MIN
from vexture.thesis.texture import ThesisTexture
from vexture.thesis.tree import CellKind, CellTree
from vexture_evidence.measures.closeups import directions
from vexture_evidence.measures.leaves import LeafArrays, Tree, quads
from vexture_evidence.measures.metrics import LEVELS, TRUTH, Errors, errors
from vexture_evidence.measures.shape import convert_by

TURN: Final = 30.0
"""Degrees. A joint at which the outline turns by more than this is a sharp corner."""

BESIDE: Final = 1 / 64
"""Unit-square units. Cells nearer to a corner than this are counted as its cells."""

DENSE: Final = 1024
"""Points on each cubic that determine which squares it passes through."""

MOST_TEXELS: Final = MOST_ROWS << ROW_BITS
"""Most texels of a packed texture, quads and curves together."""


@dataclass(frozen=True, slots=True, eq=False)
class BeforeAfter:
    """A part of a drawing, drawn from two textures.

    Parameters
    ----------
    drawing : Drawing
    before, after : ThesisTexture or Texture
    images : tuple of two (height, width) float32 arrays
        Pictures from `before` and `after`.
    truth : (height, width) float32 array
        Exact coverage.
    bounds : tuple of float
        The part that is drawn: x0, y0, x1, y1, in unit-square units.
    """

    drawing: Drawing
    before: ThesisTexture | Texture
    after: ThesisTexture | Texture
    images: tuple[NDArray[np.float32], NDArray[np.float32]]
    truth: NDArray[np.float32]
    bounds: tuple[float, float, float, float]

    @property
    def errors(self) -> tuple[Errors, Errors]:
        """Errors of the pictures from `before` and `after`."""
        return errors(self.images[0], self.truth), errors(self.images[1], self.truth)

    @property
    def stray(self) -> tuple[int, int]:
        """Number of pixels, before and after, that no outline crosses and that are wrong by more than 1/255."""
        untouched = (self.truth <= TRUTH) | (self.truth >= 1.0 - TRUTH)
        before, after = (int((untouched & (abs(image - self.truth) > 1.0 / LEVELS)).sum()) for image in self.images)
        return before, after


def close_up(
    drawing: Drawing,
    before: ThesisTexture | Texture,
    after: ThesisTexture | Texture,
    bounds: Sequence[float] = (0.0, 0.0, 1.0, 1.0),
    side: int = 128,
    *,
    as_thesis: bool = False,
) -> BeforeAfter:
    """Draw a square part of a drawing from two textures.

    Parameters
    ----------
    drawing : Drawing
    before, after : ThesisTexture or Texture
        Two textures of the drawing.
    bounds : sequence of float
        x0, y0, x1, y1 in unit-square units.
    side : int
        Side of the pictures in pixels.
    as_thesis : bool
        Draw `before` as the thesis's shader did, not as vexture's does.

    Examples
    --------
    >>> import vexture
    >>> half = Drawing.polygon([(0, 0), (1, 0), (1, 0.5), (0, 0.5)])
    >>> close = close_up(half, vexture.convert(half, encoding="thesis"), vexture.convert(half), side=4)
    >>> close.errors[1].mae < 0.1
    True
    """
    x0, y0, x1, y1 = map(float, bounds)
    size = (side, side)
    view = window(x0, y0, x1 - x0, y1 - y0).matrix(size)
    if as_thesis:
        from vexture_evidence.measures.thesis_ways import draw_as_thesis

        first = draw_as_thesis(before, size, view).image  # type: ignore[arg-type]
    else:
        first = coverage(before, size, view, "cpu")
    images = first, coverage(after, size, view, "cpu")
    return BeforeAfter(drawing, before, after, images, render_exact(drawing, size, view), (x0, y0, x1, y1))


# --- 6.1.1: the range of the control points ---------------------------------------------------------------------------


def looping(name: str = "looping") -> Drawing:
    """Return four cubics that cross themselves, each from edge to edge of one quarter of the unit square.

    Examples
    --------
    >>> from vexture.conversion.pipeline import run_encoding
    >>> run_encoding(looping(), "thesis").tree.curves.shape[0]  # one leaf for each
    4
    """
    points = np.array([(0.5, 0.2), (0.8, 0.5), (0.5, 0.8), (0.2, 0.5)])
    ends = np.roll(points, -1, axis=0)
    along = ends - points
    bulge = np.stack([along[:, 1], -along[:, 0]], axis=1)
    cubics = np.stack([points, points + 1.6 * along + bulge, points - 0.6 * along + bulge, ends], axis=1)
    return Drawing((Path((cubics,), FillRule.EVENODD),), name=name)


def clamp_curves(tree: CellTree, low: float = 0.0, high: float = 1.0) -> tuple[CellTree, int]:
    """Restore the thesis's clamp of inner control points (6.1.1).

    Parameters
    ----------
    tree : CellTree
    low, high : float
        Range of P1 and P2 along the line from P0, at 0, to P3, at 1.

    Returns
    -------
    tree : CellTree
        The tree with the same cells and clamped curves.
    changed : int
        Number of curves that were not in the range.
    """
    curves = tree.curves.copy()
    chord = curves[:, 3] - curves[:, 0]
    square = (chord**2).sum(axis=1)
    corner = np.zeros(len(curves), np.bool_)
    corner[tree.ref[tree.kind == CellKind.CORNER]] = True
    along = np.einsum("kpi,ki->kp", curves[:, 1:3] - curves[:, :1], chord) / square[:, None]
    shift = np.where(corner[:, None], 0.0, along.clip(low, high) - along)
    curves[:, 1:3] = (curves[:, 1:3] + shift[:, :, None] * chord[:, None]).clip(CONTROL_MIN, CONTROL_MAX)
    changed = int((abs(shift) > 1e-9).any(axis=1).sum())
    return replace(tree, curves=curves), changed


# --- 6.1.2: corners ---------------------------------------------------------------------------------------------------


def sharp_corners(drawing: Drawing, least: float = TURN) -> NDArray[np.float64]:
    """Points at which the outline turns by more than `least` degrees, (n, 2).

    Examples
    --------
    >>> sharp_corners(Drawing.polygon([(0, 0), (1, 0), (0, 1)])).tolist()
    [[1.0, 0.0], [0.0, 1.0], [0.0, 0.0]]
    """
    found = []
    for contour in (contour for path in drawing.paths for contour in path.contours):
        onward = -(directions(contour[:, ::-1]) * np.roll(directions(contour), -1, axis=0)).sum(axis=1)
        found.append(contour[onward < np.cos(np.radians(least)), 3])
    return np.concatenate(found) if found else np.zeros((0, 2))


def corner_cells(found: LeafArrays, corners: NDArray[np.float64], beside: float = BESIDE) -> NDArray[np.int64]:
    """Number of leaves with curves within a distance of each corner, (n,)."""
    drawn = np.unique(found.owner)
    low = np.stack([found.x, found.y], axis=1)[drawn]
    high = low + found.side[drawn, None]
    off = np.maximum(np.maximum(low - corners[:, None], corners[:, None] - high), 0.0)
    near: NDArray[np.int64] = (np.hypot(off[..., 0], off[..., 1]) < beside).sum(axis=1)
    return near


# --- 6.2.2: quads that need not have been divided ---------------------------------------------------------------------


def unnecessary_quads(drawing: Drawing, shape: Tree | ThesisTexture | Texture) -> NDArray[np.bool_]:
    """Mask, (n,), of the quads through which only one cubic of the drawing passes, and only once.

    The unit square, which is always divided, is not counted. Passes are detected by 1,024 points on each cubic.

    Examples
    --------
    >>> import vexture
    >>> half = Drawing.polygon([(0, 0), (1, 0), (1, 0.7), (0, 0.7)])
    >>> unnecessary_quads(half, vexture.convert(half)).tolist()
    [False]
    """
    found = quads(shape)
    counted = np.zeros(len(found.x), np.int64)
    t = np.arange(DENSE) / DENSE
    for contour in (contour for path in drawing.paths for contour in path.contours):
        x, y = points_along(contour, t).reshape(-1, 2).T
        owner = np.repeat(np.arange(len(contour)), DENSE)
        for k in range(len(counted)):
            inside = (x > found.x[k]) & (x < found.x[k] + found.side[k])
            inside &= (y > found.y[k]) & (y < found.y[k] + found.side[k])
            entered = inside & ~np.roll(inside, 1)
            changed = inside & np.roll(inside, 1) & (owner != np.roll(owner, 1))
            whole = inside.any() and not entered.any()  # a contour that never leaves the square
            counted[k] += int((entered | changed).sum()) + int(whole)
    counted[0] = 0
    single: NDArray[np.bool_] = counted == 1
    return single


# --- 4.3.1 and 5.1: how long the lists may be -------------------------------------------------------------------------


class Lengths(NamedTuple):
    """Size of a texture that holds several copies of a drawing.

    Attributes
    ----------
    copies : int
    entries : int or None
        The longer of the thesis's two lists, or all texels of a packed texture; None if the encoding cannot hold it.
    texture : ThesisTexture or Texture, optional
    refused : str
        Why there is no texture; empty if there is one.
    """

    copies: int
    entries: int | None
    texture: ThesisTexture | Texture | None = None
    refused: str = ""


def repeat_drawing(drawing: Drawing, across: int) -> Drawing:
    """Return a drawing that repeats another on a grid of `across` by `across` copies.

    Examples
    --------
    >>> repeat_drawing(Drawing.polygon([(0, 0), (1, 0), (0, 1)]), 3).segments
    27
    """
    paths = []
    for row in range(across):
        for column in range(across):
            for path in drawing.paths:
                contours = tuple((contour + np.array([column, row])) / across for contour in path.contours)
                paths.append(Path(contours, path.fill_rule, path.paint))
    return Drawing(tuple(paths), name=f"{drawing.name} x {across * across}")


def list_lengths(drawing: Drawing, way: dict[str, str], across: Sequence[int]) -> list[Lengths]:
    """Convert more and more copies of a drawing, until the encoding cannot hold them.

    Parameters
    ----------
    drawing : Drawing
    way : dict
        One of `vexture_evidence.measures.shape.WAYS`.
    across : sequence of int
        Numbers of copies along a side of the grid, ascending.
    """
    found: list[Lengths] = []
    for number in across:
        try:
            texture = convert_by(repeat_drawing(drawing, number), way).texture
        except LimitError as error:
            found.append(Lengths(number * number, None, refused=str(error)))
            break
        if isinstance(texture, Texture):
            entries = len(texture.flat)
        else:
            assert isinstance(texture, ThesisTexture)
            entries = max(len(texture.quads), len(texture.curves))
        found.append(Lengths(number * number, entries, texture))
    return found
