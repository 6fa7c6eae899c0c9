"""Texels that the shader reads for a pixel in colours: of a planar map, and of stacked layers.

The mirror (`vexture.renderers.colour`, `cpu`) runs with its reads counted, and what it reads once is counted as often
as the shader reads it: a piece that is not clear of the pixel twice, if its texel is not the one that was read last,
and in maps without gradients both paints beside it. Layers are visited as `vextureLayers` does it, from the top until
none below would show; one whose box the pixel does not meet costs the texel of its box.
"""

from collections.abc import Callable, Iterator, Sequence
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from vexture.drawing.drawing import Drawing
from vexture.renderers import colour, cpu
from vexture.renderers.cells import Texel
from vexture.renderers.gpu import gradients_of
from vexture.renderers.leaf import VextureLeaf
from vexture.renderers.method import BORDER, COVERED
from vexture.renderers.uniforms import Uniforms, uniforms_of
from vexture.renderers.view import ViewLike
from vexture.texture.texture import Texture
from vexture_evidence.measures.gpu_turns import observe_kernel

BOX, HEAD = 1, 1
"""Texels with the box of a layer, and with its quad and paint."""


class SecondLoop:
    """Counts the texels read again in the second loop over the pieces of a leaf: those not clear of the pixel."""

    def __init__(self, found: list[int]) -> None:
        self.found, self.at = found, 0
        self.wanted: list[int] = []

    def piece(self, result: tuple[Texel, VextureLeaf], *_: Any) -> None:
        """Record the piece that the first loop reads."""
        self.at = result[1].at

    def look(self, piece: cpu.VextureLook, *_: Any) -> None:
        """Record whether that piece is clear of the pixel."""
        if piece.crosses or piece.filled != 0.0:
            self.wanted.append(self.at)

    def end(self, *_: Any) -> None:
        """Count the reads of the second loop at the end of a leaf."""
        for at in self.wanted:
            self.found[0] += 1 if at != self.at else 0
            self.at = at
        self.wanted.clear()


class SheetStack(NamedTuple):
    """Shapes of a texture that are composited, the lowest first, and the boxes around them, (n, 2, 2)."""

    texture: Texture
    boxes: NDArray[np.float64]


def layer_boxes(drawings: Sequence[Drawing]) -> NDArray[np.float64]:
    """Lower left and upper right corners around the control points of drawings, (n, 2, 2)."""
    found = []
    for drawing in drawings:
        points = np.concatenate([contour.reshape(-1, 2) for path in drawing.paths for contour in path.contours])
        found.append((points.min(axis=0), points.max(axis=0)))
    return np.array(found)


def spread_pixels(side: int, most: int, seed: int) -> Iterator[tuple[float, float]]:
    """Centres of pixels that are spread over a square picture: one in each of `most` x `most` squares, or all."""
    rng, count = np.random.default_rng(seed), min(side, most)
    for row, column in np.ndindex(count, count):
        x, y = np.floor((np.array([column, row]) + rng.random(2)) * side / count) + 0.5
        yield float(x), float(y)


def pixel_fetches(sheets: SheetStack, side: int, view: ViewLike, most: int, seed: int) -> float:
    """Mean texels read for a pixel of a square picture, of `most` x `most` pixels that are spread over it."""
    count = _counter(sheets, side, view)
    return float(np.mean([count(pixel) for pixel in spread_pixels(side, most, seed)]))


def _counter(sheets: SheetStack, side: int, view: ViewLike) -> Callable[[tuple[float, float]], int]:
    """Make a function that counts the texels read for a pixel."""
    texture, found = sheets.texture, [0]
    uniforms = [uniforms_of(texture, side, view, root) for root in range(len(texture.roots))]
    look = _opacity(texture, uniforms, found)
    is_map = len(texture.roots) == 1 and texture.roots[0].is_map

    def count(pixel: tuple[float, float]) -> int:
        found[0], alpha = 0, 0.0
        meets = _meets(sheets.boxes, uniforms[0], pixel)
        for layer in range(len(uniforms) - 1, -1, -1):
            if alpha >= COVERED:
                break
            found[0] += BOX
            if meets[layer]:
                found[0] += HEAD
                alpha += (1.0 - alpha) * look(layer, pixel)
        return found[0]

    def count_alone(pixel: tuple[float, float]) -> int:
        found[0] = 0
        look(0, pixel)
        return found[0]

    return count_alone if is_map else count


def _opacity(
    texture: Texture, uniforms: Sequence[Uniforms], found: list[int]
) -> Callable[[int, tuple[float, float]], float]:
    """The opacity of a map or layer, by its number, at a pixel; adds the texels that are read to `found`."""
    maps = [root.quad for root in texture.roots if root.is_map]
    is_plain = not any(gradients_of(texture, quad) for quad in maps)

    def adding(texels: int) -> Callable[..., None]:
        def note(*_: Any) -> None:
            found[0] += texels

        return note

    second = SecondLoop(found)
    notes = {"texel": adding(1), "flat_look": second.look, "first_look": second.look, "leaf_piece": second.piece}
    notes |= {"add_flat_cell": second.end, "add_cell": second.end}
    if is_plain:  # flat colours are read where they are named, and not when all are summed
        notes |= {"paint_words": adding(-1), "add_paint": adding(1)}
    color = observe_kernel(colour.view_color, notes, {})
    coverage = observe_kernel(cpu.view_coverage, {"texel": adding(1), "piece": adding(1)}, {})

    def opacity(layer: int, pixel: tuple[float, float]) -> float:
        root, one = texture.roots[layer], uniforms[layer]
        flat, base, to_unit = int(one.is_flat), one.base, one.to_unit
        if root.is_map:
            alpha: float = color(texture.texels, 0, flat, one.quad, base, to_unit, pixel)[3]
            return alpha
        whole = 1.0 if root.paint is None else root.paint.opacity
        area: float = coverage(texture.texels, flat, one.quad, base, to_unit, pixel)
        return whole * area

    return opacity


def _meets(boxes: NDArray[np.float64], uniforms: Uniforms, pixel: tuple[float, float]) -> NDArray[np.bool_]:
    """Whether the box of a pixel meets those of the layers, as ``vexture_meets``."""
    place = uniforms.to_unit @ (*pixel, 1.0)
    point = place[:2] / place[2] + np.array(uniforms.base) / 2.0**32
    reach = 0.5 * abs(uniforms.to_unit[:2, :2] / place[2]).sum(axis=1)
    way = abs(point - boxes.mean(axis=1))
    meets: NDArray[np.bool_] = (way < 0.5 * (boxes[:, 1] - boxes[:, 0]) + reach + BORDER).all(axis=1)
    return meets
