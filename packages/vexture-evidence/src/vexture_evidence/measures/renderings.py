"""One view of a drawing, drawn by several methods, with the exact coverage: the data of figures of renderings."""

from collections.abc import Callable, Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

from vexture.base.errors import LimitError
from vexture.conversion.images import coverage
from vexture.drawing.drawing import Drawing
from vexture.renderers.exact import render_exact
from vexture.renderers.view import window
from vexture.texture.texture import Texture
from vexture.thesis.accuracy import accuracy_of
from vexture.thesis.texture import ThesisTexture
from vexture.tree.cubics import gather
from vexture_evidence.measures.closeups import outline_places
from vexture_evidence.measures.metrics import Errors, errors
from vexture_evidence.measures.rivals import texture_rival
from vexture_evidence.measures.shape import WAYS, ConvertedDrawing, Made, convert_by
from vexture_evidence.measures.thesis_ways import AsThesis, draw_as_thesis

CENTRE: Final = "centre of the pixel"
MIP: Final = "with MIP values"
SAMPLED: Final = "MIP values, 16 samples"
GRID: Final = "16 samples"
PACKED: Final = "packed"

EXAGGERATED: Final = 30.0
"""Pixels; the side of the quads at which thesis Figure 4.15 stops the descent, far larger than in use."""

TURNED: Final = 10.0
"""Degrees by which the view is rotated."""

LOOSE: Final = 10.0
"""Factor by which the tolerance of thesis Figure 5.12 is too large."""


@dataclass(frozen=True, slots=True, eq=False)
class Rendered:
    """Pictures of one view.

    Parameters
    ----------
    images : mapping
        Coverage, 0..1, (height, width), by the name of the method.
    truth : (height, width) float32 array
        Exact coverage.
    to_unit : (3, 3) float64 array or None
        The view; None fits the unit square.
    from_mip : (height, width) bool array or None
        True where the thesis's method used a MIP value; None if that was not recorded.
    """

    images: Mapping[str, NDArray[np.float32]]
    truth: NDArray[np.float32]
    to_unit: NDArray[np.float64] | None = None
    from_mip: NDArray[np.bool_] | None = None

    @property
    def errors(self) -> dict[str, Errors]:
        """Errors of each method."""
        return {name: errors(image, self.truth) for name, image in self.images.items()}


@dataclass(frozen=True, slots=True, eq=False)
class Fitted:
    """Result of converting a drawing in one way.

    Parameters
    ----------
    name : str
    tolerance : float
        Requested tolerance, in unit-square units; 0 is exact.
    deviation : float
        Largest distance between the outlines, as the conversion measured it, in unit-square units, before
        quantisation.
    curves : int
        Curves or pieces in the tree.
    nbytes : int
        Bytes in memory of the texture.
    """

    name: str
    tolerance: float
    deviation: float
    curves: int
    nbytes: int


def at_sizes(shape: ConvertedDrawing, sizes: Sequence[int] = (1, 2, 4, 8, 16)) -> tuple[Rendered, ...]:
    """Draw the whole shape in few pixels, by each step of the thesis's method and by the packed one (thesis 3.13).

    Parameters
    ----------
    shape : ConvertedDrawing
        If the thesis's encoding cannot hold it, its pictures are left out.
    sizes : sequence of int
        Sides of the pictures in pixels.

    Examples
    --------
    >>> from vexture_evidence.measures.shape import example
    >>> smallest, _ = at_sizes(ConvertedDrawing(example("duck")), (1, 2))
    >>> list(smallest.images)
    ['centre of the pixel', 'with MIP values', 'MIP values, 16 samples', 'packed']
    """
    return tuple(_in_view(shape, (side, side), None, {CENTRE: (1, 0.0), MIP: (1, 1.0), SAMPLED: (4, 1.0)}, MIP)
                 for side in sizes)  # fmt: skip


def at_edge(shape: ConvertedDrawing, side: int = 40, part: float = 1 / 16) -> Rendered:
    """Draw a magnified part of the outline (thesis 4.14), rotated so that edges cross the pixel grid at an angle.

    Parameters
    ----------
    shape : ConvertedDrawing
        If the thesis's encoding cannot hold it, its pictures are left out.
    side : int
        Pixels along a side.
    part : float
        Side of the part that is drawn, in unit-square units.
    """
    x, y = next(iter(outline_places(shape.drawing, 1).tolist()), (0.5, 0.5))
    view = window(x - part / 2, y - part / 2, part, part, rotate=TURNED).matrix((side, side))
    return _in_view(shape, (side, side), view, {CENTRE: (1, 1.0), GRID: (4, 1.0)})


def cut_off_at(
    shape: ConvertedDrawing, sizes: Sequence[int] = (20, 40, 80, 160, 320), *, cut_off: float = EXAGGERATED
) -> tuple[AsThesis, ...]:
    """Draw the whole shape with MIP values for far larger quads than usual (thesis 4.15).

    Raises
    ------
    LimitError
        If the thesis's encoding cannot hold the drawing.
    """
    texture = _sampled_texture(shape)
    return tuple(draw_as_thesis(texture, (side, side), samples=1, cut_off=cut_off) for side in sizes)


def with_tolerances(
    shape: ConvertedDrawing, side: int = 240, part: float = 1 / 8
) -> tuple[tuple[Fitted, ...], Rendered, Rendered, tuple[float, float, float]]:
    """Convert with the right tolerance, with one ten times too large, and to a packed texture (thesis 5.12).

    Returns
    -------
    fitted : tuple of Fitted
        The conversions; those whose encoding cannot hold the drawing are left out.
    whole, close : Rendered
        Pictures of the conversions, by their names; `close` shows the square where they differ most from the truth.
    square : tuple of float
        x, y and side of the square that `close` shows, in unit-square units.
    """
    drawing = shape.drawing
    right = accuracy_of("auto", gather(drawing)[0]).distance
    loose = LOOSE * right
    textures, fitted = {}, []
    conversion: Callable[[], Made]
    for name, tolerance, conversion in (
        ("sampled", right, lambda: shape.way("sampled")),
        ("sampled, ten times too loose", loose, lambda: convert_by(drawing, WAYS["sampled"] | {"tolerance": loose})),
        (PACKED, 0.0, lambda: shape.way(PACKED)),
    ):
        with suppress(LimitError):
            made = conversion()
            textures[name] = made.texture
            fitted.append(
                Fitted(
                    name,
                    tolerance,
                    made.tree.deviation,
                    len(made.tree.curves),
                    texture_rival(made.texture, name).gpu_bytes,
                )
            )
    whole = _all_of(drawing, textures, (side, side), None)
    off = sum(np.abs(image - whole.truth) for image in whole.images.values())
    square = *_worst(np.asarray(off), round(part * side)), part
    return (
        tuple(fitted),
        whole,
        _all_of(drawing, textures, (side, side), window(*square, part).matrix((side, side))),
        square,
    )


def _sampled_texture(shape: ConvertedDrawing) -> ThesisTexture:
    texture = shape.way("sampled").texture
    assert isinstance(texture, ThesisTexture)
    return texture


def _in_view(
    shape: ConvertedDrawing,
    size: tuple[int, int],
    to_unit: NDArray[np.float64] | None,
    ways: Mapping[str, tuple[int, float]],
    origin: str | None = None,
) -> Rendered:
    """Pictures by variants of the thesis's method, each with its samples and cut-off, and by the packed one.

    `from_mip` of the result is that of the variant which `origin` names.
    """
    images, from_mip = {}, None
    with suppress(LimitError):
        texture = _sampled_texture(shape)
        for name, (samples, cut_off) in ways.items():
            drawn = draw_as_thesis(texture, size, to_unit, samples=samples, cut_off=cut_off)
            images[name] = drawn.image
            from_mip = drawn.from_mip if name == origin else from_mip
    images[PACKED] = coverage(shape.way(PACKED).texture, size, to_unit, "cpu")
    return Rendered(images, render_exact(shape.drawing, size, to_unit), to_unit, from_mip)


def _all_of(
    drawing: Drawing,
    textures: Mapping[str, Texture | ThesisTexture],
    size: tuple[int, int],
    to_unit: NDArray[np.float64] | None,
) -> Rendered:
    images = {name: coverage(texture, size, to_unit, "cpu") for name, texture in textures.items()}
    return Rendered(images, render_exact(drawing, size, to_unit), to_unit)


def _worst(off: NDArray[np.floating[Any]], side: int) -> tuple[float, float]:
    """Lower left corner, in unit-square units, of the square of `side` pixels with the largest total error."""
    total = np.pad(off, ((1, 0), (1, 0))).cumsum(axis=0).cumsum(axis=1)
    held = total[side:, side:] - total[:-side, side:] - total[side:, :-side] + total[:-side, :-side]
    row, column = np.unravel_index(held.argmax(), held.shape)
    return float(column) / len(off), 1.0 - float(row + side) / len(off)
