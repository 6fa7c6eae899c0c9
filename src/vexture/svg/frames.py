"""The frame of a drawing: what its outermost element sets, or else what is painted."""

from math import ceil, floor, log10
from typing import Final, TypeAlias

import numpy as np

from vexture.bezier.bounds import bounds
from vexture.svg.compositing import masking
from vexture.svg.report import Report
from vexture.svg.scene import Scene
from vexture.svg.spatial import TRANSFORMS
from vexture.svg.transform import Identity, Transform
from vexture.svg.values import Viewport, is_relative
from vexture.svg.viewport import ANONYMOUS, THINNEST, Rectangle

__all__ = ["EMPTY", "Frame", "frame", "painted_frame"]

Size: TypeAlias = tuple[float, float]

Frame: TypeAlias = tuple[Size, Viewport, Transform]
"""Size of a drawing in pixels, the root's viewport, and the map from user units to pixels."""

EMPTY: Final[Frame] = (0.0, 0.0), Viewport(0.0, 0.0), Identity
"""Frame that shows nothing."""


def frame(scene: Scene) -> Frame:
    """Frame that the outermost element sets; `EMPTY`, with a note, if a side is zero."""
    root, style = scene.root, scene.style
    box = scene.view(root)
    absolute = Viewport(0.0, 0.0, style.font_size)
    sides = []
    for name in ("width", "height"):
        text = style[name]
        relative = text.lower() == "auto" or is_relative(text)
        sides.append(None if relative else absolute.length(text, 0.0, style.font_size))
    width, height = sides
    if any(side is not None and side < THINNEST for side in (*sides, *(box or ())[2:])):
        scene.report.remark("its width or height is zero, at which nothing is shown")
        return EMPTY
    if box is not None:
        ratio = box[2] / box[3]
        if width is None and height is None:
            width, height = box[2:]
        size = (width or (height or 0.0) * ratio, height or (width or 0.0) / ratio)
        return size, viewport_of(scene, box[2:], size), scene.fit(root, box, *size)
    given = width is not None, height is not None
    size = (width or ANONYMOUS[0], height or ANONYMOUS[1])
    if not all(given):
        scene.report.remark(unsized(scene, size, {(True, False): "height", (False, True): "width"}.get(given, "size")))
    return size, viewport_of(scene, size), Identity


def painted_frame(scene: Scene) -> Frame:
    """Frame around what is painted, with a note; `EMPTY` if nothing is."""
    viewport = viewport_of(scene, ANONYMOUS)
    box = painted_box(scene, viewport)
    if box is None:
        return EMPTY
    x, y, width, height = rounded(box)
    scene.report.remark(f"it has no viewBox and no size; its frame is what it paints, {written((x, y, width, height))}")
    return (width, height), viewport, Identity.translate(-x, -y)


def viewport_of(scene: Scene, sides: Size, size: Size | None = None) -> Viewport:
    """Viewport of a size in user units; `size` is that in pixels, if it is another."""
    return Viewport(*sides, scene.style.font_size, size)


def painted_box(
    scene: Scene, viewport: Viewport, size: Size | None = None, *, is_whole: bool = False
) -> Rectangle | None:
    """Bounding box of what is painted in a viewport, before the frame cuts it; None if nothing is.

    `size` is that of the frame, about the middle of which the outermost element may turn. `is_whole` asks for the box
    of the whole document, of which a part may be chosen.
    """
    fonts, page = scene.typesetter.files, scene.cascade.page
    chosen = None if is_whole else scene.chosen
    silent = Scene(scene.root, Report(), scene.images, chosen, fonts=fonts, page=page)  # notes come later
    painted, groups = silent.paint(viewport, Identity, None, size)
    masks = masking(groups)
    contours = [each for path in painted if path.group < 0 or not masks[path.group] for each in path.contours]
    if not contours:
        return None
    left, top, right, bottom = bounds(np.concatenate(contours))
    return left, top, right - left, bottom - top


def rounded(box: Rectangle) -> Rectangle:
    """A box around another one in whole units, or of a small one in parts of ten.

    Examples
    --------
    >>> rounded((1.5, -2.25, 20.0, 20.0)), rounded((0.015, 0.0, 0.5, 0.25))
    ((1.0, -3.0, 21.0, 21.0), (0.01, 0.0, 0.51, 0.25))
    """
    x, y, width, height = box
    digits = max(0, 1 - floor(log10(max(width, height, THINNEST))))
    units = 10.0**digits
    left, top = floor(round(x * units, 6)), floor(round(y * units, 6))
    right, bottom = ceil(round((x + width) * units, 6)), ceil(round((y + height) * units, 6))
    wide, high = max(right - left, 1), max(bottom - top, 1)
    return left / units, top / units, wide / units, high / units


def written(box: Rectangle) -> str:
    """A box as the attribute that sets it."""
    return f'viewBox="{" ".join(f"{value:.10g}" for value in box)}"'


def unsized(scene: Scene, size: Size, lacking: str) -> str:
    """What a note says of a drawing that lacks a size and a `viewBox`: what to write to see all of it, if it is cut."""
    told = f"it has no viewBox and no {lacking}, and is {size[0]:g} x {size[1]:g}, as in browsers"
    box = painted_box(scene, viewport_of(scene, size), size, is_whole=True)
    if box is None:
        return told
    left, top, right, bottom = box[0], box[1], box[0] + box[2], box[1] + box[3]
    if left >= 0.0 and top >= 0.0 and right <= size[0] and bottom <= size[1]:
        return told
    if not scene.style.own.keys().isdisjoint(TRANSFORMS):  # it would be about another middle with a viewBox
        return f"{told}, which cuts it"
    x, y = floor(min(left, 0.0)), floor(min(top, 0.0))
    wide, high = ceil(max(right, size[0])) - x, ceil(max(bottom, size[1])) - y
    return f'{told}, which cuts it (with viewBox="{x} {y} {wide} {high}" it shows all)'
