"""The tree of clips, fills and groups by which HarfBuzz paints a glyph in colour (COLR of OpenType, 0 and 1)."""

from collections.abc import Callable
from dataclasses import dataclass, field
from functools import cache
from typing import Any, TypeAlias

import numpy as np
from numpy.typing import NDArray

from vexture.base.notes import Notes
from vexture.bezier.convert import line_cubics
from vexture.drawing.paint import Affine, Color, Paint
from vexture.fonts.color_lines import linear, radial, solid, swept
from vexture.fonts.engine import harfbuzz

Contours: TypeAlias = tuple[NDArray[np.float64], ...]

IDENTITY: Affine = ((1.0, 0.0, 0.0), (0.0, 1.0, 0.0))


@dataclass(frozen=True, slots=True)
class Fill:
    """A paint everywhere within the clips around it."""

    paint: Paint


@dataclass(slots=True)
class Clip:
    """Content within an outline, in font units; or within a box, which is there for its bounds."""

    contours: Contours
    is_box: bool = False
    children: list["Node"] = field(default_factory=list)


@dataclass(slots=True)
class Composite:
    """Content painted on nothing, before it goes on what is below by a mode that HarfBuzz names."""

    mode: str = "SRC_OVER"
    children: list["Node"] = field(default_factory=list)


Node: TypeAlias = Fill | Clip | Composite


def paint_tree(font: Any, glyph: int, outline: Callable[[int], Contours], foreground: Color, notes: Notes) -> Composite:
    """Tree of what a glyph paints, with a note of what of it is not as it should be."""
    painter = GlyphPainter(outline, foreground, notes)
    red, green, blue = (round(255.0 * part) for part in foreground)
    font.paint_glyph(glyph, paint_funcs(), painter, 0, harfbuzz().Color(red, green, blue, 255))
    return painter.root


class GlyphPainter:
    """Builds the tree: HarfBuzz opens and closes transforms, clips and groups in turn."""

    def __init__(self, outline: Callable[[int], Contours], foreground: Color, notes: Notes) -> None:
        self.outline = outline
        self.foreground = foreground
        self.notes = notes
        self.root = Composite()
        self.open: list[Clip | Composite] = [self.root]
        self.matrices = [IDENTITY]

    def transform(self, matrix: Affine) -> None:
        """Open a transform, which comes before those that are open."""
        (a, b, c), (d, e, f) = self.matrices[-1]
        (p, q, r), (s, t, u) = matrix
        rows = (a * p + b * s, a * q + b * t, a * r + b * u + c), (d * p + e * s, d * q + e * t, d * r + e * u + f)
        self.matrices.append(rows)

    def clip(self, contours: Contours, is_box: bool = False) -> None:
        """Open a clip by an outline in the present coordinates."""
        upright = is_box and self.matrices[-1][0][1] == self.matrices[-1][1][0] == 0.0
        self.begin(Clip(tuple(transform_contour(contour, self.matrices[-1]) for contour in contours), upright))

    def begin(self, node: Clip | Composite) -> None:
        """Open a clip or group."""
        self.open[-1].children.append(node)
        self.open.append(node)

    def end(self, mode: str | None = None) -> None:
        """Close the clip or group that was opened last."""
        node = self.open.pop()
        if mode is not None and isinstance(node, Composite):
            node.mode = mode

    def fill(self, paint: Paint | None) -> None:
        """Paint, unless the paint or the present transform shows nothing."""
        (a, b, c), (d, e, f) = self.matrices[-1]
        determinant = a * e - b * d
        if paint is None or determinant == 0.0:
            return
        p, q, r, s = (part / determinant for part in (e, -b, -d, a))
        self.open[-1].children.append(Fill(paint.after(((p, q, -p * c - q * f), (r, s, -r * c - s * f)))))


def transform_contour(contour: NDArray[np.float64], matrix: Affine) -> NDArray[np.float64]:
    """A contour after an affine map."""
    (a, b, c), (d, e, f) = matrix
    x, y = contour[..., 0], contour[..., 1]
    return np.stack([a * x + b * y + c, d * x + e * y + f], axis=-1)


def rectangle(left: float, bottom: float, right: float, top: float) -> Contours:
    """Outline of a rectangle."""
    corners = np.array([(left, bottom), (right, bottom), (right, top), (left, top)])
    return (line_cubics(corners, np.roll(corners, -1, axis=0)),)


@cache
def paint_funcs() -> Any:
    """Callbacks by which HarfBuzz paints with a `GlyphPainter`."""
    funcs = harfbuzz().PaintFuncs()
    funcs.set_push_transform_func(lambda a, d, b, e, c, f, painter: painter.transform(((a, b, c), (d, e, f))))
    funcs.set_pop_transform_func(lambda painter: painter.matrices.pop())
    funcs.set_push_clip_glyph_func(lambda glyph, painter: painter.clip(painter.outline(glyph)))
    funcs.set_push_clip_rectangle_func(lambda a, b, c, d, painter: painter.clip(rectangle(a, b, c, d), True))
    funcs.set_pop_clip_func(lambda painter: painter.end())
    funcs.set_push_group_func(lambda painter: painter.begin(Composite()))
    funcs.set_pop_group_func(lambda mode, painter: painter.end(mode.name))
    funcs.set_color_func(lambda color, own, painter: painter.fill(solid(color, own, painter.foreground)))
    funcs.set_linear_gradient_func(lambda line, *args: args[-1].fill(linear(line, args[:-1], args[-1].foreground)))
    funcs.set_radial_gradient_func(
        lambda line, *args: args[-1].fill(radial(line, args[:-1], args[-1].foreground, args[-1].notes))
    )
    funcs.set_sweep_gradient_func(lambda line, *args: args[-1].fill(swept(line, args[-1].foreground, args[-1].notes)))
    return funcs
